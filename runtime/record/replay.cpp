#include "runtime/record/replay.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <map>
#include <utility>

#include "runtime/bytecode/reader/program_info.h"
#include "runtime/bytecode/reader/read_value.h"
#include "runtime/bytecode/reader/resolve_name.h"
#include "runtime/record/internal/recorded_session.h"
#include "runtime/record/internal/replay_machine.h"
#include "runtime/record/recording_format.h"
#include "runtime/record/recording_reader.h"
#include "runtime/scan/no_clock.h"

namespace stepwright::record {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t kMaxDifferences = 1'000;

std::string hex(std::uint64_t value) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

const char* name_of(scan::ScanState state) {
  constexpr std::array<const char*, 6> kNames = {"stopped",  "running",          "trapped",
                                                 "I/O lost", "watchdog expired", "overrun"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool read_block(base::ByteReader& in, Bytes& block) {
  std::uint64_t size = 0;
  if (!read_varint(in, size) || size > in.remaining()) return false;
  block = in.read_bytes(static_cast<std::size_t>(size));
  return true;
}

class Player {
 public:
  Player(RecordingReader& reader, const ReplayOptions& options) : reader_(reader), options_(options) {}

  [[nodiscard]] result::Result<ReplayReport> play();

 private:
  [[nodiscard]] result::Result<void> take(RecordKind kind, base::ByteReader in);
  [[nodiscard]] result::Result<void> take_session(base::ByteReader in);
  [[nodiscard]] result::Result<void> take_program(base::ByteReader in);
  [[nodiscard]] result::Result<void> take_state(base::ByteReader in);
  [[nodiscard]] result::Result<void> take_scan(base::ByteReader in);
  [[nodiscard]] result::Result<void> take_command(RecordKind kind, base::ByteReader in);
  [[nodiscard]] result::Result<void> take_keyframe(base::ByteReader in);
  [[nodiscard]] result::Result<void> make_machine(const std::string& digest, std::uint32_t own_tasks);
  bool read_forces(base::ByteReader& in);
  bool read_time(base::ByteReader& in, unsigned flags);
  bool change_inputs(base::ByteReader& in);
  void differ(const scan::ScanReport& report, const char* what, std::string recorded, std::string replayed);
  void compare_variables(Bytes recorded);
  tl::unexpected<result::Diagnostics> nonsense(const char* what) const {
    return reader_.fail_here("R0054", what);
  }

  RecordingReader& reader_;
  const ReplayOptions& options_;
  ReplayReport report_;
  bool done_ = false;
  RecordedSession session_;  // before the machine, which refers to it
  std::map<std::string, std::vector<std::byte>> containers_;
  scan::NoClock clock_;
  RecordedIo io_;
  std::unique_ptr<ReplayMachine> machine_;
  std::uint32_t own_tasks_ = 0;  // those that the machine runs
  std::int64_t time_ns_ = 0;
  std::int64_t step_ns_ = 0;
};

result::Result<ReplayReport> Player::play() {
  bool any = false;
  while (!done_) {
    auto record = reader_.next();
    if (record && !*record) break;
    result::Result<void> taken;
    if (record) {
      base::ByteReader in(**record);
      const auto kind = static_cast<RecordKind>(in.read<std::uint8_t>());
      if (!any && kind != RecordKind::Session)
        return nonsense("the recording does not begin with its session");
      taken = any && kind == RecordKind::Session ? nonsense("a second session") : take(kind, in);
    } else {
      taken = result::forward(record);
    }
    if (!taken) {
      // Before anything ran it is a file to refuse; later it is where the replay ends.
      if (report_.scans == 0 && !any) return result::forward(taken);
      report_.problems.insert(report_.problems.end(), taken.error().begin(), taken.error().end());
      return std::move(report_);
    }
    any = true;
  }
  if (!report_.ended && !report_.difference) {
    result::Diagnostic open;
    open.code = "R0053";
    open.severity = result::Severity::Warning;
    open.where.file = reader_.path();
    open.message = "the recording has no end mark: the runtime was killed, or is still recording";
    if (reader_.unfinished_bytes() > 0) {
      open.message += "; the last " + std::to_string(reader_.unfinished_bytes()) + " bytes (from byte " +
                      std::to_string(reader_.chunk_offset()) + ") are no whole chunk";
    }
    report_.problems.push_back(std::move(open));
  }
  return std::move(report_);
}

result::Result<void> Player::take(RecordKind kind, base::ByteReader in) {
  switch (kind) {
    case RecordKind::Session:
      return take_session(in);
    case RecordKind::Program:
      return take_program(in);
    case RecordKind::State:
      return take_state(in);
    case RecordKind::Scan:
      return take_scan(in);
    case RecordKind::Force:
    case RecordKind::Unforce:
    case RecordKind::Write:
      return take_command(kind, in);
    case RecordKind::Keyframe:
      return take_keyframe(in);
    case RecordKind::Stop:
      ++report_.stops;
      // Outputs go to their safe state; the next scan comes after a State only.
      if (machine_ != nullptr) machine_->cycle.stop();
      return {};
    case RecordKind::Load:
      return {};
    case RecordKind::Gap: {
      const auto scan = in.read<std::uint64_t>();
      if (!in.ok()) return nonsense("a gap without its scan");
      report_.gaps.push_back(scan);
      result::Diagnostic gap{
          "R0056",
          result::Severity::Warning,
          {reader_.path(), 0, 0},
          "scans are missing from scan " + std::to_string(scan) + " on: the recording could not follow",
          ""};
      report_.problems.push_back(std::move(gap));
      return {};
    }
    case RecordKind::End:
      report_.ended = true;
      done_ = true;
      return {};
  }
  return nonsense("a record of an unknown kind");
}

result::Result<void> Player::take_session(base::ByteReader in) {
  const char* wrong = session_.read(in);
  return wrong == nullptr ? result::Result<void>() : nonsense(wrong);
}

result::Result<void> Player::take_program(base::ByteReader in) {
  Bytes digest, container;
  if (!read_block(in, digest) || !read_block(in, container)) return nonsense("a program that is cut short");
  containers_[text_of(digest)].assign(container.begin(), container.end());
  return {};
}

result::Result<void> Player::make_machine(const std::string& digest, std::uint32_t own_tasks) {
  const auto found = containers_.find(digest);
  if (found == containers_.end()) return nonsense("the program of a state is missing");
  auto loaded = reader::LoadedProgram::load(found->second, reader_.path());
  if (!loaded) return result::forward(loaded);
  // The engine refers to the bytes, which a move keeps.
  auto engine = options_.engine(loaded->program());
  if (!engine) return result::forward(engine);
  scan::ScanConfig config;
  config.budget = session_.budget();
  config.own_tasks = own_tasks;
  config.safe_state = session_.matrix();
  const bool other = machine_ == nullptr || machine_->digest != digest;
  machine_ =
      std::make_unique<ReplayMachine>(digest, std::move(*loaded), std::move(*engine), io_, clock_, config);
  if (!other) return {};
  ++report_.programs;
  return options_.on_program ? options_.on_program(machine_->loaded) : result::Result<void>();
}

result::Result<void> Player::take_state(base::ByteReader in) {
  const auto cause = static_cast<StateCause>(in.read<std::uint8_t>());
  Bytes digest;
  if (!read_block(in, digest)) return nonsense("a state without its program");
  scan::CyclePoint point;
  if (!read_point(in, point)) return nonsense("a state that cannot be");
  std::uint32_t own_tasks = 0;
  for (std::uint32_t i = 0; i < point.task_count; ++i) own_tasks |= 1u << point.tasks[i].index;
  if (machine_ == nullptr || machine_->digest != text_of(digest) || own_tasks != own_tasks_) {
    if (auto made = make_machine(text_of(digest), own_tasks); !made) return made;
    own_tasks_ = own_tasks;
  }
  if (!fits(point, machine_->cycle.point(), machine_->loaded.program()))
    return nonsense("a state of another program");
  if (!read_forces(in)) return nonsense("forces that are cut short, or one outside the image");
  image::ProcessImage& image = machine_->image;
  Bytes bytes;
  if (!read_block(in, bytes) || bytes.size() != image.bytes().size())
    return nonsense("an image of another size");
  std::copy(bytes.begin(), bytes.end(), image.bytes().begin());
  machine_->cycle.resume(point);
  report_.trace_hash = point.trace_hash;
  io_.inputs.assign(image.inputs().size(), std::byte{0});
  time_ns_ = point.last_time_ns;
  step_ns_ = 0;
  if (cause == StateCause::Start) ++report_.starts;
  if (point.scan >= options_.until) done_ = report_.ended = true;
  return {};
}

bool Player::read_forces(base::ByteReader& in) {
  std::uint64_t count = 0;
  if (!read_varint(in, count)) return false;
  image::ForceTable& forces = machine_->cycle.forces();
  forces.clear_all();
  for (std::uint64_t i = 0; i < count; ++i) {
    image::Force force;
    force.address = in.read<std::uint32_t>();
    force.bit = in.read<std::uint8_t>();
    force.size = in.read<std::uint8_t>();
    force.value = in.read<std::uint64_t>();
    if (!in.ok() || !forces.set(force, machine_->image.bytes().size())) return false;
  }
  return true;
}

// The time of the next scan. The sum of an instant and a distance that is none of two instants may be no
// number.
bool Player::read_time(base::ByteReader& in, unsigned flags) {
  std::uint64_t step = zigzag(step_ns_);
  if ((flags & kScanStep) != 0 && !read_varint(in, step)) return false;
  step_ns_ = unzigzag(step);
  if (step_ns_ < -kLatestNs || step_ns_ > kLatestNs || !is_instant(time_ns_ + step_ns_)) return false;
  time_ns_ += step_ns_;
  return true;
}

bool Player::change_inputs(base::ByteReader& in) {
  std::uint64_t at = 0;
  while (!in.at_end()) {
    std::uint64_t distance = 0;
    Bytes run;
    if (!read_varint(in, distance) || !read_block(in, run)) return false;
    if (distance > io_.inputs.size() - at || run.size() > io_.inputs.size() - at - distance) return false;
    at += distance;
    std::copy(run.begin(), run.end(), io_.inputs.begin() + static_cast<std::ptrdiff_t>(at));
    at += run.size();
  }
  return true;
}

result::Result<void> Player::take_scan(base::ByteReader in) {
  const unsigned flags = in.read<std::uint8_t>();
  if (machine_ == nullptr || machine_->cycle.state() != scan::ScanState::Running) {
    // After a difference the replay may have trapped where the recording went on.
    if (report_.difference) return {};
    return nonsense("a scan while no program runs");
  }
  if (!read_time(in, flags)) return nonsense("a scan at a time that cannot be");
  const std::uint64_t hash = (flags & kScanHash) != 0 ? in.read<std::uint64_t>() : 0;
  if (!in.ok() || ((flags & kScanInputs) != 0 && !change_inputs(in)))
    return nonsense("a scan that is cut short");
  io_.read_good = (flags & kScanReadLost) == 0;
  io_.write_good = (flags & kScanWriteLost) == 0;

  scan::ScanCycle& cycle = machine_->cycle;
  const std::int64_t due_ns = cycle.next_time_ns();
  if (due_ns < time_ns_) cycle.skip_to(time_ns_);
  const scan::ScanReport report = cycle.run_scan();
  if (report_.scans++ == 0) report_.first_scan = report.scan;
  report_.last_scan = report.scan;
  // Between two states a time may go back, and a made-up sum be no number.
  report_.simulated_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(report_.simulated_ns) +
                                                   static_cast<std::uint64_t>(step_ns_));
  report_.trace_hash = cycle.trace_hash();
  if (report.trap) report_.trap = reader::describe(machine_->loaded.program(), report.trap);
  if (options_.on_scan) options_.on_scan(report, machine_->image);

  const auto state = static_cast<scan::ScanState>(flags >> kScanStateShift & 7);
  if (state > scan::ScanState::Overrun) return nonsense("a scan that ends in no state");
  if (state == scan::ScanState::WatchdogExpired || state == scan::ScanState::Overrun) {
    // How long something took is not in a recording: its end is taken as it is.
    machine_->cycle.stop(scan::SafeCause::Watchdog);
    return {};
  }
  if (report.time_ns != time_ns_) {
    differ(report, "time", std::to_string(time_ns_) + " ns", std::to_string(report.time_ns) + " ns");
  } else if (report.state != state) {
    differ(report, "state", name_of(state), name_of(report.state));
  } else if ((flags & kScanHash) != 0) {
    ++report_.hashes;
    if (report.image_hash != hash) differ(report, "image", hex(hash), hex(report.image_hash));
  }
  if (report.scan >= options_.until) done_ = report_.ended = true;
  return {};
}

void Player::differ(const scan::ScanReport& report, const char* what, std::string recorded,
                    std::string replayed) {
  if (report_.difference) return;
  report_.difference = Difference{report.scan, what, std::move(recorded), std::move(replayed), 0, {}};
}

result::Result<void> Player::take_command(RecordKind kind, base::ByteReader in) {
  if (machine_ == nullptr) return {};
  ++report_.commands;
  const std::span<std::byte> image = machine_->image.bytes();
  const auto address = in.read<std::uint32_t>();
  if (kind == RecordKind::Write) {
    Bytes bytes;
    if (!read_block(in, bytes) || address > image.size() || bytes.size() > image.size() - address) {
      return nonsense("a write outside the image");
    }
    std::copy(bytes.begin(), bytes.end(), image.begin() + address);
    return {};
  }
  const auto bit = in.read<std::uint8_t>();
  if (kind == RecordKind::Unforce) {
    if (!in.ok()) return nonsense("a command that is cut short");
    machine_->cycle.forces().clear(address, bit);
    return {};
  }
  const auto size = in.read<std::uint8_t>();
  const auto value = in.read<std::uint64_t>();
  if (!in.ok() || !machine_->cycle.forces().set({address, bit, size, value}, image.size())) {
    return nonsense("a force outside the image");
  }
  return {};
}

result::Result<void> Player::take_keyframe(base::ByteReader in) {
  Bytes bytes;
  if (machine_ == nullptr || !read_block(in, bytes) || bytes.size() != machine_->image.bytes().size()) {
    return nonsense("a keyframe of another size");
  }
  ++report_.keyframes;
  if (!std::equal(bytes.begin(), bytes.end(), machine_->image.bytes().begin())) {
    const scan::ScanReport last{machine_->cycle.state(), report_.last_scan, time_ns_, 0, {}};
    differ(last, "image", "keyframe", "another image");
  }
  if (report_.difference) {
    compare_variables(bytes);
    done_ = true;  // what follows tells nothing more
  }
  return {};
}

void Player::compare_variables(Bytes recorded) {
  Difference& difference = *report_.difference;
  difference.keyframe_scan = report_.last_scan;
  const auto info = reader::ProgramInfo::read(machine_->loaded.bytes());
  if (!info) return;
  const Bytes replayed = machine_->image.bytes();
  std::vector<bool> named(replayed.size(), false);
  for (const reader::Tag& tag : info->tags()) {
    named[tag.variable.address] = true;
    std::string before = reader::read_text(tag.variable, recorded);
    std::string now = reader::read_text(tag.variable, replayed);
    if (before == now || difference.variables.size() == kMaxDifferences) continue;
    difference.variables.push_back({tag.name, std::move(before), std::move(now)});
  }
  // Inputs and outputs that no variable stands for.
  const std::size_t areas = machine_->image.inputs().size() + machine_->image.outputs().size();
  for (std::uint32_t at = 0; at < areas; ++at) {
    if (named[at] || recorded[at] == replayed[at] || difference.variables.size() == kMaxDifferences) continue;
    const auto text = [at](Bytes image) { return std::to_string(std::to_integer<unsigned>(image[at])); };
    difference.variables.push_back(
        {reader::name_of_place(*info, at, bytecode::kNoBit, 1), text(recorded), text(replayed)});
  }
}

}  // namespace

result::Result<ReplayReport> replay(const std::string& path, const ReplayOptions& options) {
  auto reader = RecordingReader::open(path);
  if (!reader) return result::forward(reader);
  return Player(**reader, options).play();
}

}  // namespace stepwright::record

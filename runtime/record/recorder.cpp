#include "runtime/record/recorder.h"

#include <algorithm>
#include <future>
#include <new>
#include <system_error>
#include <utility>

namespace stepwright::record {
namespace {

using Clock = std::chrono::steady_clock;

// Programs before the one that runs; a change that is taken back makes one of them run again.
constexpr std::ptrdiff_t kKeptBefore = 4;

std::int64_t unix_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

// Of a State or Load record: the digest of its program.
std::string digest_of(std::span<const std::byte> record, std::size_t at) {
  base::ByteReader in(record);
  static_cast<void>(in.read_bytes(at));
  std::uint64_t size = 0;
  read_varint(in, size);
  const auto text = in.read_bytes(static_cast<std::size_t>(size));
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

}  // namespace

Recorder::~Recorder() {
  quit_.store(true);
  join();
}

void Recorder::join() {
  if (writer_.joinable()) writer_.join();
}

RecordingState Recorder::state() const {
  const std::lock_guard lock(mutex_);
  return status_.state;
}

RecordingStatus Recorder::status() const {
  const std::lock_guard lock(mutex_);
  RecordingStatus status = status_;
  if (session_ != nullptr) {
    status.scans = session_->scans.load();
    status.gaps = session_->gaps.load();
    status.first_gap = session_->first_gap.load();
  }
  return status;
}

result::Result<Session*> Recorder::begin(const RecordingOptions& options, RuntimeFacts facts) {
  if (active()) {
    return result::fail("R0052", {options.file.string(), 0, 0},
                        "a recording is under way already: " + status().file, "end it first");
  }
  join();
  if (session_ != nullptr && !session_->released.load()) retired_.push_back(std::move(session_));
  std::erase_if(retired_, [](const auto& session) { return session->released.load(); });
  // All that may be refused comes first: then nothing has changed, the files neither.
  std::unique_ptr<Session> session;
  std::promise<bool> opened;
  std::thread writer;
  try {
    session = std::make_unique<Session>(options.ring_bytes, std::max(options.hash_every, 1u),
                                        options.keyframe_every);
    writer = std::thread([this, go = opened.get_future()]() mutable {
      if (go.get()) write_until_end();
    });
  } catch (const std::bad_alloc&) {
    return result::fail("R0072", {options.file.string(), 0, 0}, "the system gives no memory for a recording");
  } catch (const std::system_error& error) {
    return result::fail("R0071", {options.file.string(), 0, 0},
                        std::string("the system gives no thread for a recording: ") + error.what(),
                        "the limit of processes (ulimit -u) may be reached");
  }
  writer_ = std::move(writer);
  options_ = options;
  options_.hash_every = std::max(options.hash_every, 1u);
  facts_ = std::move(facts);
  segment_ = 0;
  ended_ = false;
  quit_.store(false);
  if (auto made = open_file(); !made) {
    opened.set_value(false);
    join();
    return result::forward(made);
  }
  session_ = std::move(session);
  {
    const std::lock_guard lock(mutex_);
    status_ = {};
    status_.state = RecordingState::Recording;
    status_.file = options.file.string();
    announced_.clear();
  }
  opened.set_value(true);
  return session_.get();
}

void Recorder::abandon() {
  session_->released.store(true);
  quit_.store(true);
  join();
}

void Recorder::announce(const std::string& digest, std::span<const std::byte> container) {
  auto copy = std::make_shared<const std::vector<std::byte>>(container.begin(), container.end());
  const std::lock_guard lock(mutex_);
  std::erase_if(announced_, [&](const auto& known) { return known.first == digest; });
  announced_.emplace_back(digest, std::move(copy));
}

// The container of a program that begins to run. What was announced long before it will not run again.
Recorder::Container Recorder::announced(const std::string& digest) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(announced_.begin(), announced_.end(),
                                  [&](const auto& known) { return known.first == digest; });
  if (found == announced_.end()) return nullptr;
  Container container = found->second;
  if (found - announced_.begin() > kKeptBefore) announced_.erase(announced_.begin(), found - kKeptBefore);
  return container;
}

void Recorder::write_until_end() {
  std::vector<std::byte> record;
  auto flushed_at = Clock::now();
  result::Result<void> outcome;
  while (outcome && !ended_) {
    const bool last = quit_.load();
    while (outcome && !ended_ && session_->ring.pop(record)) outcome = take(record);
    if (last) break;
    if (outcome && Clock::now() - flushed_at >= kFlushPeriod) {
      outcome = file_->flush();
      flushed_at = Clock::now();
    }
    if (!outcome || ended_) break;
    if (options_.max_bytes > 0 && file_->bytes() >= options_.max_bytes / 2)
      session_->want_segment.store(true);
    {
      const std::lock_guard lock(mutex_);
      status_.bytes = file_->bytes();
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
  if (outcome) outcome = file_->close();
  finish(outcome);
}

void Recorder::finish(const result::Result<void>& outcome) {
  const std::lock_guard lock(mutex_);
  status_.bytes = file_ == nullptr ? 0 : file_->bytes();
  status_.state = outcome ? RecordingState::Done : RecordingState::Failed;
  if (!outcome) status_.problem = result::to_string(outcome.error());
  session_->failed.store(true, std::memory_order_release);
  file_.reset();
  announced_.clear();
}

result::Result<void> Recorder::take(std::span<const std::byte> record) {
  const auto kind = static_cast<RecordKind>(record[0]);
  if (kind == RecordKind::State) {
    if (static_cast<StateCause>(record[1]) == StateCause::Segment) {
      if (auto begun = next_segment(); !begun) return begun;
    }
    if (auto added = add_program(digest_of(record, 2)); !added) return added;
  }
  ended_ = kind == RecordKind::End;
  return file_->add(record);
}

result::Result<void> Recorder::open_file() {
  auto file = RecordingFile::create(options_.file);
  if (!file) return result::forward(file);
  file_ = std::move(*file);
  written_.clear();
  std::size_t bytes = 64;
  for (const scan::SafeRules& rules : facts_.safe_state) {
    bytes += 2 * kMaxVarintBytes + rules.outputs.size() * 8 + rules.ramps.size() * 24;
  }
  std::vector<std::byte> buffer(bytes);
  Encoder out(buffer);
  out.put(RecordKind::Session).put(static_cast<std::uint8_t>(facts_.real_time ? 1 : 0)).put(unix_ns());
  out.put(facts_.budget).put(segment_++).put(options_.hash_every).put(options_.keyframe_every);
  for (const scan::SafeRules& rules : facts_.safe_state) {
    out.put_varint(rules.outputs.size());
    for (const scan::SafeOutput& rule : rules.outputs) {
      out.put(rule.byte).put(rule.mask).put(rule.mode).put(rule.value);
    }
    out.put_varint(rules.ramps.size());
    for (const scan::SafeRamp& ramp : rules.ramps) {
      out.put(ramp.byte).put(ramp.type).put(ramp.target).put(ramp.per_second);
    }
  }
  assert(out.good());
  return file_->add(out.bytes());
}

result::Result<void> Recorder::next_segment() {
  if (auto closed = file_->close(); !closed) return closed;
  return open_file();
}

result::Result<void> Recorder::add_program(const std::string& digest) {
  if (std::find(written_.begin(), written_.end(), digest) != written_.end()) return {};
  const Container container = announced(digest);
  if (container == nullptr) {
    return result::fail("R0054", {options_.file.string(), 0, 0},
                        "the program " + digest + " was not announced");
  }
  std::vector<std::byte> record(container->size() + digest.size() + 1 + 2 * kMaxVarintBytes);
  Encoder out(record);
  out.put(RecordKind::Program).put_block(std::as_bytes(std::span(digest))).put_block(*container);
  written_.push_back(digest);
  return file_->add(out.bytes());
}

}  // namespace stepwright::record

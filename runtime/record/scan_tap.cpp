#include "runtime/record/scan_tap.h"

#include <algorithm>

namespace stepwright::record {
namespace {

// The largest input area that a cell can be configured with.
constexpr std::size_t kMaxInputs = 64u << 10;
// Runs cost at most their bytes again: one changed byte takes three.
constexpr std::size_t kScratch = 4 * kMaxInputs;
constexpr std::size_t kHeads = 4'096;

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

// The bytes that differ, as (distance, count, bytes) from the front; a distance counts from the end of the
// run before. Equal bytes in fours or fewer are cheaper inside a run than between two.
void put_difference(Encoder& out, std::span<const std::byte> before, std::span<const std::byte> now) {
  constexpr std::size_t kWorthwhile = 4;
  std::size_t end = 0;  // of the run before
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i] == before[i]) continue;
    const std::size_t begin = i;
    std::size_t last = i;
    for (; i < now.size() && i - last <= kWorthwhile; ++i) {
      if (now[i] != before[i]) last = i;
    }
    out.put_varint(begin - end).put_block(now.subspan(begin, last + 1 - begin));
    end = last + 1;
    i = last;
  }
}

}  // namespace

Session::Session(std::size_t ring_bytes, std::uint32_t hash_every_scans, std::uint32_t keyframe_every_scans)
    : ring(ring_bytes),
      inputs(kMaxInputs),
      scratch(kScratch),
      hash_every(hash_every_scans),
      keyframe_every(keyframe_every_scans) {}

void ScanTap::begin(Session* session) {
  if (session_ != nullptr) session_->released.store(true, std::memory_order_release);
  session_ = session;
  in_gap_ = false;
}

void ScanTap::end(std::string_view reason) {
  if (session_ == nullptr) return;
  Encoder out(session_->scratch);
  out.put(RecordKind::End).put(scan_).put_block(bytes_of(reason));
  // Without room the recording ends without its mark, as after a kill.
  static_cast<void>(session_->ring.push({out.bytes()}));
  session_->released.store(true, std::memory_order_release);
  session_ = nullptr;
}

bool ScanTap::usable() {
  if (session_ == nullptr) return false;
  if (!session_->failed.load(std::memory_order_acquire)) return true;
  session_->released.store(true, std::memory_order_release);
  session_ = nullptr;
  return false;
}

bool ScanTap::has_room(std::size_t image_bytes) const {
  if (session_ == nullptr || session_->failed.load(std::memory_order_acquire)) return true;
  // A scan, a keyframe and a state.
  return session_->ring.room() >=
         std::min(2 * image_bytes + kScratch + kHeads, session_->ring.capacity() / 2);
}

void ScanTap::lose(std::uint64_t scan) {
  in_gap_ = true;
  if (session_->gaps.fetch_add(1, std::memory_order_relaxed) == 0) session_->first_gap.store(scan);
}

// Any record but a scan: what is lost here makes the next scan unknown.
void ScanTap::push(std::span<const std::byte> record) {
  if (!in_gap_ && !session_->ring.push({record})) lose(scan_ + 1);
}

void ScanTap::state(StateCause cause, const Running& program) {
  if (!usable()) return;
  if (in_gap_) cause = StateCause::Resume;
  if (!push_state(cause, program)) {
    if (!in_gap_) lose(program.cycle.scan() + 1);
  }
}

bool ScanTap::push_state(StateCause cause, const Running& program) {
  const scan::CyclePoint point = program.cycle.point();
  Encoder out(session_->scratch);
  if (cause == StateCause::Resume) {
    // The gap stands before the state in one record of its own, pushed only if both have room.
    if (session_->ring.room() < program.image.bytes().size() + kHeads) return false;
    Encoder gap(session_->scratch);
    gap.put(RecordKind::Gap).put(scan_ + 1);
    if (!session_->ring.push({gap.bytes()})) return false;
  }
  out.put(RecordKind::State).put(cause).put_block(bytes_of(program.digest));
  out.put(point.state).put(point.scan).put(point.last_time_ns).put(point.trace_hash);
  out.put_varint(point.task_count);
  for (std::uint32_t i = 0; i < point.task_count; ++i) {
    out.put(static_cast<std::uint8_t>(point.tasks[i].index));
    out.put(point.tasks[i].due_ns).put(static_cast<std::uint8_t>(point.tasks[i].triggered ? 1 : 0));
  }
  const auto forces = program.cycle.forces().forces();
  out.put_varint(forces.size());
  for (const image::Force& force : forces)
    out.put(force.address).put(force.bit).put(force.size).put(force.value);
  out.put_varint(program.image.bytes().size());
  if (!session_->ring.push({out.bytes(), program.image.bytes()})) return false;
  in_gap_ = false;
  scan_ = point.scan;
  time_ns_ = point.last_time_ns;
  step_ns_ = 0;
  std::fill_n(session_->inputs.begin(), program.image.inputs().size(), std::byte{0});
  return true;
}

void ScanTap::scanned(const scan::ScanReport& report, const ScanIo& io, const Running& program) {
  if (!usable()) return;
  if (in_gap_) {
    // The state after this scan is one to go on from. The scans in between are lost.
    static_cast<void>(push_state(StateCause::Resume, program));
    return;
  }
  scan::ScanReport recorded = report;
  // What a watchdog ended was not ended by what a replay can repeat.
  const bool late = report.state == scan::ScanState::Trapped && program.cycle.watchdog_report().took_ns != 0;
  if (late) recorded.state = scan::ScanState::WatchdogExpired;
  if (!push_scan(recorded, io)) return lose(report.scan);
  session_->scans.fetch_add(1, std::memory_order_relaxed);
  if (session_->keyframe_every > 0 && report.scan % session_->keyframe_every == 0) {
    Encoder out(session_->scratch);
    out.put(RecordKind::Keyframe).put_varint(program.image.bytes().size());
    // One that finds no room is left out: the hashes tell that all is well without it.
    static_cast<void>(session_->ring.push({out.bytes(), program.image.bytes()}));
  }
  if (session_->want_segment.load(std::memory_order_relaxed) && report.state == scan::ScanState::Running &&
      push_state(StateCause::Segment, program)) {
    session_->want_segment.store(false, std::memory_order_relaxed);
  }
}

bool ScanTap::push_scan(const scan::ScanReport& report, const ScanIo& io) {
  const std::int64_t step_ns = report.time_ns - time_ns_;
  const auto before = std::span<const std::byte>(session_->inputs).first(io.inputs.size());
  const bool changed = !std::equal(io.inputs.begin(), io.inputs.end(), before.begin());
  const bool hashed = report.scan % session_->hash_every == 0 || report.state != scan::ScanState::Running;
  unsigned flags = static_cast<unsigned>(report.state) << kScanStateShift;
  if (changed) flags |= kScanInputs;
  if (!io.read_good) flags |= kScanReadLost;
  if (!io.write_good) flags |= kScanWriteLost;
  if (hashed) flags |= kScanHash;
  if (step_ns != step_ns_) flags |= kScanStep;
  Encoder out(session_->scratch);
  out.put(RecordKind::Scan).put(static_cast<std::uint8_t>(flags));
  if ((flags & kScanStep) != 0) out.put_varint(zigzag(step_ns));
  if (hashed) out.put(report.image_hash);
  if (changed) put_difference(out, before, io.inputs);
  if (!out.good() || !session_->ring.push({out.bytes()})) return false;
  if (changed) std::copy(io.inputs.begin(), io.inputs.end(), session_->inputs.begin());
  scan_ = report.scan;
  time_ns_ = report.time_ns;
  step_ns_ = step_ns;
  return true;
}

void ScanTap::loaded(std::string_view digest) {
  if (!usable()) return;
  Encoder out(session_->scratch);
  push(out.put(RecordKind::Load).put_block(bytes_of(digest)).bytes());
}

void ScanTap::stopped(std::string_view reason) {
  if (!usable()) return;
  Encoder out(session_->scratch);
  push(out.put(RecordKind::Stop).put_block(bytes_of(reason)).bytes());
}

void ScanTap::forced(const image::Force& force) {
  if (!usable()) return;
  Encoder out(session_->scratch);
  push(out.put(RecordKind::Force).put(force.address).put(force.bit).put(force.size).put(force.value).bytes());
}

void ScanTap::unforced(std::uint32_t address, std::uint8_t bit) {
  if (!usable()) return;
  Encoder out(session_->scratch);
  push(out.put(RecordKind::Unforce).put(address).put(bit).bytes());
}

void ScanTap::wrote(std::uint32_t address, std::span<const std::byte> bytes) {
  if (!usable()) return;
  Encoder out(session_->scratch);
  push(out.put(RecordKind::Write).put(address).put_block(bytes).bytes());
}

}  // namespace stepwright::record

#include "runtime/record/internal/recorded_session.h"

#include <cmath>

#include "runtime/record/recording_format.h"

namespace stepwright::record {
namespace {

constexpr std::size_t kOutputBytes = 7;
constexpr std::size_t kRampBytes = 21;

// A count of records of this size that the bytes left can hold.
bool read_count(base::ByteReader& in, std::size_t record_bytes, std::uint64_t& count) {
  return read_varint(in, count) && count <= in.remaining() / record_bytes;
}

// Within the range of its type, so that the number on its way there is, too.
bool is_ramp(const scan::SafeRamp& ramp) {
  if (ramp.type > scan::RampType::F32) return false;
  if (!std::isfinite(ramp.target) || !std::isfinite(ramp.per_second) || ramp.per_second <= 0.0) return false;
  constexpr std::array<std::array<double, 2>, 7> kRanges = {
      {{0.0, 255.0},
       {-128.0, 127.0},
       {0.0, 65'535.0},
       {-32'768.0, 32'767.0},
       {0.0, 4'294'967'295.0},
       {-2'147'483'648.0, 2'147'483'647.0},
       {-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()}}};
  const auto& range = kRanges[static_cast<std::size_t>(ramp.type)];
  return ramp.target >= range[0] && ramp.target <= range[1];
}

}  // namespace

const char* RecordedSession::read(base::ByteReader in) {
  in.read<std::uint8_t>();
  in.read<std::int64_t>();
  budget_ = in.read<std::uint64_t>();
  for (int i = 0; i < 3; ++i) in.read<std::uint32_t>();  // segment, hash_every, keyframe_every
  if (!in.ok()) return "a session that is cut short";
  if (budget_ > scan::ScanConfig{}.budget) return "a budget that no runtime gives a scan";
  for (SafeColumn& column : columns_) {
    if (!read_column(in, column)) return "a safe state that is cut short, or that no runtime has";
  }
  return nullptr;
}

bool RecordedSession::read_column(base::ByteReader& in, SafeColumn& column) {
  std::uint64_t count = 0;
  if (!read_count(in, kOutputBytes, count)) return false;
  column = {};
  for (std::uint64_t i = 0; i < count; ++i) {
    scan::SafeOutput rule;
    rule.byte = in.read<std::uint32_t>();
    rule.mask = in.read<std::uint8_t>();
    rule.mode = static_cast<scan::SafeMode>(in.read<std::uint8_t>());
    rule.value = in.read<std::uint8_t>();
    if (rule.mode > scan::SafeMode::Value) return false;
    column.outputs.push_back(rule);
  }
  if (!read_count(in, kRampBytes, count)) return false;
  for (std::uint64_t i = 0; i < count; ++i) {
    scan::SafeRamp ramp;
    ramp.byte = in.read<std::uint32_t>();
    ramp.type = static_cast<scan::RampType>(in.read<std::uint8_t>());
    ramp.target = in.read<double>();
    ramp.per_second = in.read<double>();
    if (!is_ramp(ramp)) return false;
    column.ramps.push_back(ramp);
  }
  return in.ok();
}

scan::SafeMatrix RecordedSession::matrix() const {
  scan::SafeMatrix matrix;
  for (std::size_t i = 0; i < columns_.size(); ++i) matrix[i] = {columns_[i].outputs, columns_[i].ramps};
  return matrix;
}

bool read_point(base::ByteReader& in, scan::CyclePoint& point) {
  point = {};
  point.state = static_cast<scan::ScanState>(in.read<std::uint8_t>());
  point.scan = in.read<std::uint64_t>();
  point.last_time_ns = in.read<std::int64_t>();
  point.trace_hash = in.read<std::uint64_t>();
  std::uint64_t tasks = 0;
  if (!read_varint(in, tasks) || tasks == 0 || tasks > bytecode::kMaxTasks) return false;
  for (; point.task_count < tasks; ++point.task_count) {
    scan::CyclePoint::Task& task = point.tasks[point.task_count];
    task.index = in.read<std::uint8_t>();
    task.due_ns = in.read<std::int64_t>();
    task.triggered = in.read<std::uint8_t>() != 0;
    if (task.index >= bytecode::kMaxTasks) return false;
  }
  return in.ok() && point.state <= scan::ScanState::Overrun && is_instant(point.last_time_ns);
}

bool fits(const scan::CyclePoint& point, const scan::CyclePoint& own, const bytecode::Program& program) {
  if (point.task_count != own.task_count) return false;
  for (std::uint32_t i = 0; i < point.task_count; ++i) {
    const scan::CyclePoint::Task& task = point.tasks[i];
    if (task.index != own.tasks[i].index) return false;
    // Of one that does not run nothing is due, whatever stands there.
    if (point.state != scan::ScanState::Running) continue;
    const auto record = program.container().record<bytecode::Section::Tasks>(task.index);
    // What runs on its trigger only is never due.
    const bool event = record.interval_us == 0 && record.trigger != bytecode::kNoIndex;
    if (event ? task.due_ns != scan::kNever : !is_instant(task.due_ns)) return false;
  }
  return true;
}

}  // namespace stepwright::record

#include "runtime/scan/task_table.h"

namespace stepwright::scan {

using bytecode::Section;

bool Task::trigger_now(std::span<const std::byte> image) const {
  const auto byte = std::to_integer<unsigned>(image[trigger]);
  return trigger_bit == bytecode::kNoBit ? byte != 0 : ((byte >> trigger_bit) & 1u) != 0;
}

void Task::restart(std::int64_t time_ns) {
  due_at(interval_ns > 0 ? time_ns + options.phase_ns : kNever);
  counted_ns = due_ns;
  triggered = false;
  watchdog.reset();
}

// A shorter interval must not wait for the end of the longer one before it.
void Task::take_over(const Task& other, std::int64_t next_ns) {
  triggered = other.triggered;
  if (interval_ns == 0 || other.interval_ns == 0) return;
  const std::int64_t latest_ns = next_ns + interval_ns;
  due_at(other.due_ns < latest_ns ? other.due_ns : latest_ns);
}

Overrun settle_overrun(Task& task, std::int64_t now_ns) {
  Overrun found;
  if (task.interval_ns == 0 || task.freewheeling || now_ns - task.due_ns < task.interval_ns) return found;
  // The newest cycle that should have begun by now.
  const std::int64_t newest_ns = task.due_ns + (now_ns - task.due_ns) / task.interval_ns * task.interval_ns;
  if (task.counted_ns < task.due_ns) task.counted_ns = task.due_ns;
  if (newest_ns > task.counted_ns) {
    found.missed = static_cast<std::uint64_t>((newest_ns - task.counted_ns) / task.interval_ns);
    task.counted_ns = newest_ns;
  }
  found.fault = task.options.overrun == OverrunPolicy::Fault;
  const std::int64_t backlog = task.options.overrun == OverrunPolicy::CatchUp ? kMaxBacklog : 0;
  const std::int64_t oldest_ns = newest_ns - backlog * task.interval_ns;
  if (task.due_ns < oldest_ns) {
    found.skipped = static_cast<std::uint64_t>((oldest_ns - task.due_ns) / task.interval_ns);
    task.due_ns = oldest_ns;
  }
  return found;
}

// Tasks of equal priority keep the order of the container.
TaskTable::TaskTable(const bytecode::Program& program, std::span<const TaskOptions> options,
                     std::uint32_t mask) {
  const bytecode::ContainerView& view = program.container();
  for (std::uint32_t i = 0; i < view.count<Section::Tasks>(); ++i) {
    if (((mask >> i) & 1u) == 0) continue;
    const bytecode::TaskRecord record = view.record<Section::Tasks>(i);
    std::size_t at = count_++;
    for (; at > 0 && tasks_[at - 1].priority > record.priority; --at) tasks_[at] = tasks_[at - 1];
    Task& task = tasks_[at];
    task = {};
    task.index = i;
    task.interval_ns = std::int64_t{record.interval_us} * 1000;
    task.priority = record.priority;
    task.first_call = record.first_call;
    task.call_count = record.call_count;
    task.frames = program.frames_of(i);
    if (i < options.size()) task.options = options[i];
    task.watchdog = TaskWatchdog(task.options.watchdog);
    if (record.trigger != bytecode::kNoIndex) {
      const bytecode::SymbolRecord symbol = view.record<Section::Symbols>(record.trigger);
      task.trigger = symbol.address;
      task.trigger_bit = symbol.bit;
    } else if (task.interval_ns == 0) {
      task.freewheeling = true;
      task.interval_ns = kFreewheelNs;
    }
  }
}

std::int64_t TaskTable::next_time_ns() const {
  std::int64_t next = kNever;
  for (const Task& task : tasks()) {
    if (task.due_ns < next) next = task.due_ns;
  }
  return next;
}

}  // namespace stepwright::scan

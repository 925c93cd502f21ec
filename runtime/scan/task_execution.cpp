#include "runtime/scan/task_execution.h"

#include <limits>

namespace stepwright::scan {
namespace {

using bytecode::Section;

bytecode::Trap run_calls(const ExecutionPlace& place, const Task& task, std::int64_t time_ns,
                         std::uint64_t& budget) {
  for (std::uint32_t i = 0; i < task.call_count; ++i) {
    const auto call = place.program.container().record<Section::ProgramCalls>(task.first_call + i);
    const bytecode::Trap trap =
        place.engine.run({call.function, call.instance, time_ns, task.frames}, place.memory, budget);
    if (trap) return trap;
  }
  return {};
}

}  // namespace

Execution execute(const ExecutionPlace& place, Task& task, std::int64_t time_ns, std::uint64_t& budget) {
  Execution done;
  TaskWatchdog& watchdog = task.watchdog;
  const bool timed = place.measured || watchdog.on() || place.watch != nullptr;
  if (timed) done.begin_ns = place.clock.now_ns();
  if (place.watch != nullptr) {
    const std::int64_t longest_ns = watchdog.longest_ns();
    const bool bounded = longest_ns < TaskWatchdog::kNoLimit - done.begin_ns;
    place.watch->begin(bounded ? done.begin_ns + longest_ns : TaskWatchdog::kNoLimit);
  }
  // What the time allows is not a matter of code.
  const bool by_time = watchdog.on() && place.watch != nullptr && place.watch->interrupt() != nullptr;
  std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();
  done.trap = run_calls(place, task, time_ns, by_time ? unlimited : budget);
  if (place.watch != nullptr) place.watch->end();
  if (timed) done.end_ns = place.clock.now_ns();
  if (!watchdog.on()) return done;
  const std::int64_t took_ns = done.end_ns - done.begin_ns;
  if (!watchdog.executed(took_ns)) return done;
  done.watchdog = {task.index, took_ns, watchdog.limits(), watchdog.too_long()};
  if (done.trap || task.call_count == 0) return done;
  done.late = true;
  const auto call = place.program.container().record<Section::ProgramCalls>(task.first_call);
  done.trap = {bytecode::TrapCode::Watchdog, call.function};
  return done;
}

}  // namespace stepwright::scan

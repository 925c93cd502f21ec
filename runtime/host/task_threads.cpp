#include "runtime/host/task_threads.h"

#include <utility>

namespace stepwright::host {

TaskThreads::TaskThreads(const bytecode::Program& program, image::ProcessImage& image, scan::ScanCycle& cycle,
                         const WorkerSetup& setup, const TaskPlan& plan,
                         std::vector<std::unique_ptr<bytecode::Engine>> engines,
                         std::span<SeqCell<scan::TaskTiming>> timings)
    : share_{program,        image,           cycle,        setup.clock, setup.merge_map, setup.monitor,
             setup.stall_ns, setup.origin_ns, setup.budget, {},          setup.failed} {
  share_.wake_others = [this] { look_at_triggers(); };
  const scan::TaskTable table(program, plan.options, ~plan.own_tasks);
  const std::vector<std::uint32_t> others = plan.others();
  for (std::size_t i = 0; i < others.size(); ++i) {
    for (const scan::Task& task : table.tasks()) {
      if (task.index != others[i]) continue;
      workers_.push_back(std::make_unique<TaskWorker>(share_, task, std::move(engines[i]),
                                                      plan.tasks[task.index].placement, timings[task.index]));
    }
  }
}

void TaskThreads::start(std::int64_t time_ns) {
  ++share_.epoch;
  share_.running = true;
  for (const auto& worker : workers_) worker->start(time_ns);
}

void TaskThreads::take_over(TaskThreads& before, std::span<const std::uint32_t> counterparts,
                            std::int64_t time_ns) {
  before.stop();
  ++share_.epoch;
  share_.running = true;
  for (const auto& worker : workers_) {
    const scan::Task* counterpart = nullptr;
    for (const auto& other : before.workers_) {
      if (other->task().index == counterparts[worker->task().index]) counterpart = &other->task();
    }
    worker->take_over(counterpart, time_ns);
  }
}

void TaskThreads::stop() {
  if (!share_.running) return;
  share_.running = false;
  for (const auto& worker : workers_) worker->rest();
}

}  // namespace stepwright::host

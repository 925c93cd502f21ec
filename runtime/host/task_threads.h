#pragma once

// The tasks of a program that have threads of their own (real time), and what they share with the scan
// thread. The scan thread holds the mutex of the tasks over its whole scan and releases it while it waits;
// the workers hold it for the copies at either end of their cycles. Without workers nothing is locked.
//
//   TaskThreads tasks(...);                      // threads rest
//   { const auto hold = tasks.hold(); tasks.start(time_ns); }
//   { const auto hold = tasks.hold(); cycle.run_scan(); tasks.look_at_triggers(); }
//
// Threads: the scan thread, with the mutex held; built and destroyed by the service thread.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "runtime/host/merge_map.h"
#include "runtime/host/task_plan.h"
#include "runtime/host/task_worker.h"

namespace stepwright::host {

// Settings and services of the workers from outside of the program.
struct WorkerSetup {
  const MergeMap& merge_map;
  scan::Clock& clock;
  ScanMonitor* monitor = nullptr;  // null: nobody looks at the threads
  std::int64_t stall_ns = 0;       // see ThreadLiveness
  std::int64_t origin_ns = 0;      // what the clock shows at scan time 0
  std::uint64_t budget = 0;        // of a task's cycle
  // Called by a worker when a fault of its task has ended the program; neither blocks nor throws.
  std::function<void()> failed = [] {};
};

class TaskThreads {
 public:
  // References must outlive the object. `engines` holds one for each of plan.others(), `timings` an entry for
  // each task of the program. Throws std::system_error where the system gives no threads.
  TaskThreads(const bytecode::Program& program, image::ProcessImage& image, scan::ScanCycle& cycle,
              const WorkerSetup& setup, const TaskPlan& plan,
              std::vector<std::unique_ptr<bytecode::Engine>> engines,
              std::span<SeqCell<scan::TaskTiming>> timings);

  // Holds off the workers while it lives; does nothing without workers.
  class Hold {
   public:
    explicit Hold(PriorityMutex* mutex) : mutex_(mutex) {
      if (mutex_ != nullptr) mutex_->lock();
    }
    ~Hold() {
      if (mutex_ != nullptr) mutex_->unlock();
    }
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;

   private:
    PriorityMutex* mutex_;
  };
  [[nodiscard]] Hold hold() { return Hold(workers_.empty() ? nullptr : &share_.mutex); }

  bool empty() const { return workers_.empty(); }

  // All tasks anew, their first cycles at `time_ns` and their phases.
  void start(std::int64_t time_ns);
  // Go on where the tasks of another program stand: `counterparts[i]` is the one that task i stands for, or
  // kNoIndex. Requires that the mutexes of both are held; the tasks of `before` stop.
  void take_over(TaskThreads& before, std::span<const std::uint32_t> counterparts, std::int64_t time_ns);
  // Stops all tasks; a cycle that is under way no longer counts.
  void stop();
  void look_at_triggers() {
    for (const auto& worker : workers_) worker->look_at_trigger();
  }

 private:
  WorkerShare share_;
  std::vector<std::unique_ptr<TaskWorker>> workers_;
};

}  // namespace stepwright::host

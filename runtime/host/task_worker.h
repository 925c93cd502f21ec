#pragma once

// A task on a thread of its own (real time): waits until it is due or its trigger rises, takes a copy of the
// shared image, runs on the copy without a lock, and brings what it changed back value by value. So a task
// that is preempted never sees half of what another one wrote, and a more urgent task never waits for longer
// than a copy.
//
// Threads: the worker's own; functions that say "with the mutex" require WorkerShare::mutex. No heap or log
// while it runs; one lock at either end of a cycle.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "runtime/bytecode/engine.h"
#include "runtime/host/merge_map.h"
#include "runtime/host/priority_mutex.h"
#include "runtime/host/real_time.h"
#include "runtime/host/scan_monitor.h"
#include "runtime/host/seq_cell.h"
#include "runtime/host/wake_signal.h"
#include "runtime/image/process_image.h"
#include "runtime/scan/scan_cycle.h"

namespace stepwright::host {

// State that the workers of one program share with the scan thread.
struct WorkerShare {
  const bytecode::Program& program;
  image::ProcessImage& image;
  scan::ScanCycle& cycle;
  scan::Clock& clock;
  const MergeMap& merge_map;
  ScanMonitor* monitor = nullptr;
  std::int64_t stall_ns = 0;   // of the workers' liveness
  std::int64_t origin_ns = 0;  // what the clock shows at scan time 0
  std::uint64_t budget = 0;    // of a task's cycle
  // Called by a worker after it has written to the image: others may wait for the values.
  std::function<void()> wake_others;
  // Called by a worker when a fault of its task has ended the program: the scan thread has to report it.
  std::function<void()> failed;
  PriorityMutex mutex{};  // guards image, cycle and what follows
  bool running = false;
  std::uint64_t epoch = 0;  // counts starts: what a task began before one does not count after it
};

class TaskWorker {
 public:
  // Starts the thread; it rests until the first `start`. `engine` is the worker's own. All else must outlive
  // it. Throws std::system_error where the system gives no thread; then nobody knows of it.
  TaskWorker(WorkerShare& share, const scan::Task& task, std::unique_ptr<bytecode::Engine> engine,
             const ThreadPlacement& placement, SeqCell<scan::TaskTiming>& timing);
  // Ends the thread after the cycle that it is in.
  ~TaskWorker();
  TaskWorker(const TaskWorker&) = delete;
  TaskWorker& operator=(const TaskWorker&) = delete;

  // With the mutex: the task starts anew, due from `time_ns` on.
  void start(std::int64_t time_ns);
  // With the mutex: the same, but as `before`, a task of another program, would go on; null: due at
  // `time_ns`.
  void take_over(const scan::Task* before, std::int64_t time_ns);
  // With the mutex: wakes the thread, which finds that nothing runs.
  void rest();
  // With the mutex, after anything was written to the shared image: sets the task off if its trigger has
  // risen.
  void look_at_trigger();

  const scan::Task& task() const { return task_; }

 private:
  void go_on();
  void run(const ThreadPlacement& placement);
  void wait();
  void cycle();
  bool take(std::int64_t& time_ns, scan::TaskCycle& measured);
  void give_back(const scan::Execution& done, scan::TaskCycle measured);
  bool tell_of_fault();
  void publish_if_due(std::int64_t now_ns);

  WorkerShare& share_;
  scan::Task task_;
  std::unique_ptr<bytecode::Engine> engine_;
  SeqCell<scan::TaskTiming>& published_;
  std::vector<std::byte> memory_;  // image and frames of this task's own
  std::vector<std::byte> before_;  // the image as the task got it
  scan::TaskTiming timing_;
  ThreadLiveness liveness_;  // says something during an execution only
  MonitorWatch watch_;
  std::int64_t published_ns_ = 0;
  std::uint64_t epoch_ = 0;
  bool active_ = false;   // was started and nothing has stopped it
  bool pending_ = false;  // the trigger has risen and no cycle has begun since
  WakeSignal wake_;
  std::atomic<std::int64_t> wake_ns_;  // when the thread is to wake by itself; kNever: not at all
  std::atomic<bool> quit_{false};
  std::thread thread_;  // last: it uses the rest
};

}  // namespace stepwright::host

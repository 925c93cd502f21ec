#pragma once

// One planning in a thread of its own, so that whoever waits for the plan can watch the plant meanwhile.
//
//   PlanningJob job(service, {.start = start, .remaining = left});
//   while (!job.wait(milliseconds(20))) { if (news) job.cancel(); }
//   auto outcome = job.take();
//
// Threads: all calls from one thread. The service must outlive the job; the end of a job that is not done
// cancels it and waits for its thread.

#include <atomic>
#include <chrono>
#include <future>
#include <vector>

#include "supervisor/executive/planning_service.h"

namespace stepwright::executive {

class PlanningJob {
 public:
  PlanningJob(const PlanningService& planning, PlanRequest request);
  ~PlanningJob();
  PlanningJob(const PlanningJob&) = delete;
  PlanningJob& operator=(const PlanningJob&) = delete;

  // True once it is done, at the latest after `timeout`.
  bool wait(std::chrono::milliseconds timeout);
  // The search ends at its next look at the flag; the outcome is then Cancelled, or what was ready before.
  void cancel() { cancelled_ = true; }
  // Once, after wait() was true.
  [[nodiscard]] result::Result<PrepareOutcome> take() { return future_.get(); }

 private:
  std::atomic<bool> cancelled_{false};
  std::future<result::Result<PrepareOutcome>> future_;
};

}  // namespace stepwright::executive

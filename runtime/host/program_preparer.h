#pragma once

// Prepares programs on a thread of its own: to verify, translate and place a large one takes seconds, in
// which the service goes on. Programs that have ended are destroyed here too, as that waits for the cycles of
// their tasks.
//
// Threads: one of its own does the work, one job after the other; all functions belong to the service's
// thread. Invariants: bounded in number; a failure of a job (memory, threads) is its outcome and has no other
// effect; each accepted job is taken exactly once.
//
//   ProgramPreparer preparer(work, [&] { news.notify(); });
//   if (auto accepted = preparer.submit(std::move(job)); !accepted) ...
//   while (auto done = preparer.take()) ...

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "runtime/host/change_plan.h"
#include "runtime/host/messages.h"
#include "runtime/host/prepared_program.h"
#include "runtime/host/program_registry.h"

namespace stepwright::host {

struct PreparationJob {
  std::uint64_t ticket = 0;
  std::vector<std::byte> container;
  std::string digest;
  DownloadMode mode = DownloadMode::Replace;
  PreparedProgram* running = nullptr;  // DownloadMode::Change: what it is to take over from; outlives the job
};

// A program that is ready for the scan thread, or why there is none.
struct Preparation {
  std::uint64_t ticket = 0;
  std::unique_ptr<PreparedProgram> program;
  std::unique_ptr<ChangePlan> plan;  // of a change
  result::Diagnostics problems;
};

class ProgramPreparer {
 public:
  static constexpr std::size_t kMaxJobs = 4;
  using Work = std::function<result::Result<Preparation>(PreparationJob)>;

  // `work` is called on the preparer's thread, `done` as well, after each job.
  ProgramPreparer(Work work, std::function<void()> done) : work_(std::move(work)), done_(std::move(done)) {}
  // After the job that is under way; the others are dropped.
  ~ProgramPreparer();
  ProgramPreparer(const ProgramPreparer&) = delete;
  ProgramPreparer& operator=(const ProgramPreparer&) = delete;

  // Fails with R0006 (too many) or R0071 (the system gives no thread).
  [[nodiscard]] result::Result<void> submit(PreparationJob job);
  // In the order of the jobs.
  std::optional<Preparation> take();
  // Jobs that nobody has taken yet.
  std::size_t under_way() const { return under_way_; }
  // Destroyed behind the jobs that are waiting.
  void discard(std::vector<ProgramRegistry::Held> programs);

 private:
  void run();
  Preparation perform(PreparationJob job) const;

  const Work work_;
  const std::function<void()> done_;
  std::size_t under_way_ = 0;

  std::mutex mutex_;  // of what follows
  std::condition_variable wanted_;
  std::deque<PreparationJob> jobs_;
  std::vector<ProgramRegistry::Held> discarded_;
  std::deque<Preparation> finished_;
  bool quit_ = false;
  std::thread thread_;  // from the first job on
};

}  // namespace stepwright::host

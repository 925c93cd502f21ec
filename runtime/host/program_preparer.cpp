#include "runtime/host/program_preparer.h"

#include <new>
#include <system_error>
#include <utility>

#include "runtime/host/busy.h"

namespace stepwright::host {

ProgramPreparer::~ProgramPreparer() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  wanted_.notify_one();
  thread_.join();
}

result::Result<void> ProgramPreparer::submit(PreparationJob job) {
  if (under_way_ >= kMaxJobs) return busy();
  if (!thread_.joinable()) {
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error& error) {
      return result::fail("R0071", {"download", 0, 0},
                          std::string("the system gives no thread to prepare a program: ") + error.what(),
                          "the limit of processes (ulimit -u) may be reached");
    }
  }
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  ++under_way_;
  wanted_.notify_one();
  return {};
}

std::optional<Preparation> ProgramPreparer::take() {
  if (under_way_ == 0) return std::nullopt;
  const std::lock_guard lock(mutex_);
  if (finished_.empty()) return std::nullopt;
  --under_way_;
  Preparation done = std::move(finished_.front());
  finished_.pop_front();
  return done;
}

void ProgramPreparer::discard(std::vector<ProgramRegistry::Held> programs) {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    for (ProgramRegistry::Held& each : programs) discarded_.push_back(std::move(each));
  }
  wanted_.notify_one();
}

void ProgramPreparer::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wanted_.wait(lock, [this] { return quit_ || !jobs_.empty() || !discarded_.empty(); });
    if (quit_) return;
    std::vector<ProgramRegistry::Held> gone = std::exchange(discarded_, {});
    if (!gone.empty()) {
      lock.unlock();
      gone.clear();
      lock.lock();
      continue;
    }
    PreparationJob job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    Preparation done = perform(std::move(job));
    lock.lock();
    finished_.push_back(std::move(done));
    done_();
  }
}

Preparation ProgramPreparer::perform(PreparationJob job) const {
  Preparation done;
  done.ticket = job.ticket;
  try {
    auto prepared = work_(std::move(job));
    if (prepared) {
      prepared->ticket = done.ticket;
      return std::move(*prepared);
    }
    done.problems = std::move(prepared.error());
  } catch (const std::bad_alloc&) {
    done.problems = {{"R0072",
                      result::Severity::Error,
                      {"download", 0, 0},
                      "the system gives no memory for the program; nothing was changed",
                      "a smaller program, or a higher limit of memory (MemoryMax= of the unit, ulimit -v)"}};
  }
  return done;
}

}  // namespace stepwright::host

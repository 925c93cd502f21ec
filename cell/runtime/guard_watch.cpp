#include "cell/runtime/guard_watch.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "cell/runtime/guard_process.h"
#include "runtime/ground/result/counted.h"
#include "runtime/io_memory/process_mark.h"

namespace stepwright::cell_runtime {
namespace {

using std::chrono::milliseconds;

// Who is to start another one beside this process, an init system say, has this time.
constexpr milliseconds kMissing{300};
// A guard that was started has this time until it watches.
constexpr milliseconds kRetry{2'000};
// One that is not heard of for so long stands still; it looks every few milliseconds.
constexpr milliseconds kStill{2'000};
constexpr int kStillTimeouts = 10;

}  // namespace

GuardWatch::GuardWatch(const config::CellConfig& config, const CellIo& io, log::Logger& log)
    : config_(config), io_(io), log_(log) {}

result::Result<void> GuardWatch::start() {
  if (!config_.safety.guard.enabled || io_.guarded()) return {};
  auto started = start_guard(config_);
  if (started) child_ = *started;
  if (started || io_.guarded()) return {};
  return result::forward(started);
}

void GuardWatch::turn(Clock::time_point now) {
  if (!config_.safety.guard.enabled) return;
  reap();
  const io_memory::GuardFigures guard = io_.guard();
  if (!guard.there) return replace(now);
  if (missing_) {
    missing_ = false;
    note_ = "the guard was lost " + result::counted(lost_, "time", "times") + ", another one watches";
    log_.warning("guard", "another guard watches the outputs", {{"lost", lost_}});
  }
  end_silent(guard, now);
}

void GuardWatch::replace(Clock::time_point now) {
  if (!missing_) {
    missing_ = true;
    missing_since_ = now;
    tried_ = {};
    ++lost_;
    note_ = "no guard watches the outputs";
    log_.error("guard", "the guard is gone: no guard watches the outputs, another one is started",
               {{"lost", lost_}});
  }
  if (now - missing_since_ < kMissing || (tried_ != Clock::time_point{} && now - tried_ < kRetry)) return;
  tried_ = now;
  auto started = spawn_guard(config_);
  if (started) {
    child_ = *started;
  } else {
    log_.error("guard", result::to_string(started.error()));
  }
}

// The lock that it holds keeps every other guard out.
void GuardWatch::end_silent(const io_memory::GuardFigures& guard, Clock::time_point now) {
  const Clock::duration still =
      std::max<Clock::duration>(kStill, config_.safety.guard.timeout * kStillTimeouts);
  if (std::chrono::nanoseconds(guard.silent_ns) < still || now - tried_ < kRetry) return;
  tried_ = now;
  const int process = io_memory::open_process(guard.process);
  const bool ended = process >= 0 && io_memory::kill_process(process);
  if (process >= 0) close(process);
  note_ = "the guard stands still";
  log_.error("guard", std::string("the guard stands still: it is ") +
                          (ended ? "ended, and another one started" : "another user's and cannot be ended"));
}

void GuardWatch::reap() {
  if (child_ >= 0 && waitpid(child_, nullptr, WNOHANG) != 0) child_ = -1;
}

}  // namespace stepwright::cell_runtime

#include "cell/processes/kept_process.h"

#include <cstring>

#include "runtime/ground/result/counted.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::processes {
namespace {

using process::ExitStatus;

constexpr int kSignal = 128;  // is added to the number of a signal

std::string words_of(const ExitStatus& exit) {
  if (!exit.killed) return "ended with " + std::to_string(exit.code);
  const char* const name = sigabbrev_np(exit.code - kSignal);
  return std::string("was ended by the signal ") + (name == nullptr ? "?" : name);
}

// It has said what is wrong with its input, and would say it again.
bool is_refusal(const ExitStatus& exit) {
  return !exit.killed &&
         (exit.code == to_int(result::ExitCode::BadInput) || exit.code == to_int(result::ExitCode::Usage));
}

std::string seconds_text(std::chrono::milliseconds time) {
  std::string text = std::to_string(time.count() / 1'000) + "." + std::to_string(time.count() / 100 % 10);
  return text + " s";
}

}  // namespace

const char* to_string(Phase phase) {
  constexpr const char* kWords[] = {"waiting", "starting", "ready", "restarting", "failed", "ended"};
  return kWords[static_cast<std::size_t>(phase)];
}

result::Result<KeptProcess> KeptProcess::make(std::string name, process::ChildOptions options,
                                              RestartSettings settings,
                                              std::optional<std::chrono::milliseconds> silence) {
  auto pipe = LinePipe::open();
  if (!pipe) return result::forward(pipe);
  options.output = pipe->writing_end();
  const auto asked = silence ? std::chrono::microseconds(*silence) : std::chrono::microseconds(0);
  options.environment.push_back("WATCHDOG_USEC=" + (silence ? std::to_string(asked.count()) : std::string()));
  // Who watches over this process does not watch over that one.
  options.environment.emplace_back("WATCHDOG_PID=");
  std::optional<LifeWatch> life;
  if (silence) life.emplace(*silence);
  return KeptProcess(std::move(name), std::move(options), std::move(*pipe), settings, life);
}

result::Result<void> KeptProcess::start() {
  auto child = process::ChildProcess::start(options_);
  phase_ = child ? Phase::Starting : Phase::Failed;
  if (!child) return result::forward(child);
  child_.emplace(std::move(*child));
  silent_ = false;
  if (life_) life_->end();
  return {};
}

void KeptProcess::hear(const process::Notice& notice, Time now) {
  if (pid() == 0 || notice.sender != pid()) return;
  if (notice.status) status_ = *notice.status;
  if (life_ && notice.alive) life_->heard(now);
  if (!notice.ready) return;
  policy_.ready(now);
  was_ready_ = true;
  phase_ = Phase::Ready;
}

std::string KeptProcess::ended(Time now) {
  const bool ready = phase_ == Phase::Ready;
  const std::string what = words_of(*exit_);
  if (ending_) {
    phase_ = Phase::Ended;
    return "";
  }
  if (!silent_) reason_ = what;
  if (!was_ready_ && is_refusal(*exit_)) {
    phase_ = Phase::Failed;
    return what + ": what it said stands above";
  }
  const auto rest = policy_.ended(now);
  if (!rest) {
    phase_ = Phase::Failed;
    return what + ", " + result::counted(static_cast<std::uint64_t>(policy_.failures()), "time", "times") +
           " before it was ready: it is left alone";
  }
  phase_ = Phase::Resting;
  start_at_ = now + *rest;
  return what + (ready ? "" : " before it was ready") + ": it is started again in " + seconds_text(*rest);
}

// At its end it has other things to do than to give signs of life.
std::string KeptProcess::silenced(Time now) {
  if (!life_ || ending_ || silent_ || !life_->silent(now)) return "";
  silent_ = true;
  reason_ = "gave no sign of life for " + seconds_text(life_->longest());
  kill_now();
  return reason_ + ": it hangs, and is killed";
}

std::string KeptProcess::turn(Time now) {
  if (runs() && child_) {
    exit_ = child_->poll();
    return exit_ ? ended(now) : silenced(now);
  }
  if (phase_ != Phase::Resting || now < start_at_) return "";
  ++restarts_;
  const auto started = start();
  return started ? "" : result::to_string(started.error());
}

std::vector<std::string> KeptProcess::lines() {
  return runs() ? pipe_.lines() : pipe_.last_lines();
}

void KeptProcess::ask_to_end() {
  ending_ = true;
  if (runs() && child_) {
    child_->ask_to_end();
  } else if (phase_ != Phase::Failed) {
    phase_ = Phase::Ended;
  }
}

void KeptProcess::kill_now() {
  if (runs() && child_) child_->kill_now();
}

}  // namespace stepwright::processes

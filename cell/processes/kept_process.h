#pragma once

// One process of a cell that is kept alive: started, heard until it is ready, and started again when it ends,
// as long as that makes sense (restart_policy.h). One that falls silent is killed, and so started again.
//
//   auto link = KeptProcess::make("link", {.arguments = ..., .environment = {listener.variable()}});
//   link->start(now);
//   link->hear(notice);
//   if (const std::string news = link->turn(now); !news.empty()) print(news);
//
// Threads: one. Nothing blocks but the end of a process that goes out of scope.

#include <optional>
#include <string>
#include <vector>

#include "cell/processes/life_watch.h"
#include "cell/processes/line_pipe.h"
#include "cell/processes/restart_policy.h"
#include "runtime/ground/process/child_process.h"
#include "runtime/ground/process/notify_listener.h"
#include "runtime/ground/result/result.h"

namespace stepwright::processes {

enum class Phase : std::uint8_t {
  Waiting,   // not started yet
  Starting,  // runs, and has not said that it is ready
  Ready,
  Resting,  // has ended, and will be started again
  Failed,   // has ended, and will not
  Ended     // as it was asked to
};
const char* to_string(Phase phase);

class KeptProcess {
 public:
  using Time = RestartPolicy::Time;

  // `options` without an output: what the process prints comes from lines(). `silence`: it is asked for signs
  // of life (WATCHDOG_USEC of sd_notify), and once it has given the first it hangs if none comes for so long;
  // none: it is not asked. Fails with M0014.
  [[nodiscard]] static result::Result<KeptProcess> make(
      std::string name, process::ChildOptions options, RestartSettings settings = {},
      std::optional<std::chrono::milliseconds> silence = std::nullopt);

  // Fails with M0001; it is Failed then.
  [[nodiscard]] result::Result<void> start();
  // Takes what its process has said.
  void hear(const process::Notice& notice, Time now);
  // Looks whether it has ended or hangs, and starts it again when it is time to. What there is to tell of it,
  // in one line; empty: nothing.
  std::string turn(Time now);
  // The lines that it has printed since.
  std::vector<std::string> lines();

  // From here on it is not started again.
  void ask_to_end();
  void kill_now();

  const std::string& name() const { return name_; }
  Phase phase() const { return phase_; }
  bool runs() const { return phase_ == Phase::Starting || phase_ == Phase::Ready; }
  pid_t pid() const { return runs() && child_ ? child_->pid() : 0; }
  int restarts() const { return restarts_; }
  // What it has said of itself last.
  const std::string& status() const { return status_; }
  // How it has ended last.
  const std::optional<process::ExitStatus>& exit() const { return exit_; }
  // Why it had to be started again last, in a few words; empty: it has not.
  const std::string& reason() const { return reason_; }
  int descriptor() const { return pipe_.descriptor(); }

 private:
  KeptProcess(std::string name, process::ChildOptions options, LinePipe pipe, RestartSettings settings,
              std::optional<LifeWatch> life)
      : name_(std::move(name)),
        options_(std::move(options)),
        pipe_(std::move(pipe)),
        policy_(settings),
        life_(life) {}
  std::string ended(Time now);
  std::string silenced(Time now);

  std::string name_;
  process::ChildOptions options_;
  LinePipe pipe_;
  RestartPolicy policy_;
  std::optional<LifeWatch> life_;
  std::optional<process::ChildProcess> child_;
  Phase phase_ = Phase::Waiting;
  bool ending_ = false;
  bool was_ready_ = false;  // once, whatever came then
  int restarts_ = 0;
  Time start_at_{};  // while it is Resting
  std::string status_;
  bool silent_ = false;  // it was killed for that
  std::string reason_;
  std::optional<process::ExitStatus> exit_;
};

}  // namespace stepwright::processes

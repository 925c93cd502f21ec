#pragma once

// Switches of a board, for a process: the reset button is SIGUSR1, the mains switch SIGTERM or SIGINT.
//
// Threads: make it before any thread is started, as threads inherit the blocked signals; then one.

#include <sys/signalfd.h>
#include <unistd.h>

#include <csignal>

namespace stepwright::boards {

enum class Switch { None, Reset, Off };

class Switches {
 public:
  Switches() {
    sigset_t signals;
    ::sigemptyset(&signals);
    for (const int signal : {SIGUSR1, SIGTERM, SIGINT}) ::sigaddset(&signals, signal);
    ::sigprocmask(SIG_BLOCK, &signals, nullptr);
    descriptor_ = ::signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
  }
  ~Switches() { ::close(descriptor_); }
  Switches(const Switches&) = delete;
  Switches& operator=(const Switches&) = delete;

  // Which one was used since the last call. Never waits.
  Switch used() {
    signalfd_siginfo info;
    if (::read(descriptor_, &info, sizeof info) != sizeof info) return Switch::None;
    return info.ssi_signo == SIGUSR1 ? Switch::Reset : Switch::Off;
  }

 private:
  int descriptor_;
};

}  // namespace stepwright::boards

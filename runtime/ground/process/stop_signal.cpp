#include "runtime/ground/process/stop_signal.h"

#include <poll.h>
#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cerrno>

namespace stepwright::process {

// A blocked signal comes even where it is ignored.
bool ends_on_hangup() {
  struct sigaction action {};
  return sigaction(SIGHUP, nullptr, &action) != 0 || action.sa_handler != SIG_IGN;
}

StopSignal::StopSignal(OnHangup hangup) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  if (hangup == OnHangup::End && ends_on_hangup()) sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  descriptor_ = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
}

StopSignal::~StopSignal() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool StopSignal::came() const {
  return wait_for(std::chrono::milliseconds(0));
}

bool StopSignal::wait_for(std::chrono::milliseconds time) const {
  pollfd ready{descriptor_, POLLIN, 0};
  return poll(&ready, 1, static_cast<int>(time.count())) > 0;
}

void StopSignal::wait() const {
  pollfd ready{descriptor_, POLLIN, 0};
  while (poll(&ready, 1, -1) < 0 && errno == EINTR) {
    // A signal that is not ours came between.
  }
}

}  // namespace stepwright::process

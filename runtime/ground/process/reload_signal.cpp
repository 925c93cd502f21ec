#include "runtime/ground/process/reload_signal.h"

#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace stepwright::process {

ReloadSignal::ReloadSignal() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  descriptor_ = signalfd(-1, &signals, SFD_CLOEXEC | SFD_NONBLOCK);
}

ReloadSignal::~ReloadSignal() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool ReloadSignal::take() {
  bool came = false;
  signalfd_siginfo info;
  while (read(descriptor_, &info, sizeof info) == static_cast<ssize_t>(sizeof info)) came = true;
  return came;
}

}  // namespace stepwright::process

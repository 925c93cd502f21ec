#include "runtime/ground/process/interruption.h"

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>

namespace stepwright::process {
namespace {

// Takes the signal that came; from then on the next one has its default effect, which ends the process.
void let_the_next_one_kill(int descriptor) {
  signalfd_siginfo taken{};
  if (read(descriptor, &taken, sizeof(taken)) < 0) return;  // somebody else has taken it
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

Interruption::Interruption() : over_(eventfd(0, EFD_CLOEXEC)), watcher_([this] { watch(); }) {}

Interruption::~Interruption() {
  eventfd_write(over_, 1);
  watcher_.join();
  close(over_);
}

void Interruption::watch() {
  std::array<pollfd, 2> ready{pollfd{over_, POLLIN, 0}, pollfd{signal_.descriptor(), POLLIN, 0}};
  nfds_t watched = ready.size();
  while (poll(ready.data(), watched, -1) < 0 || ready[0].revents == 0) {
    if (watched < ready.size() || ready[1].revents == 0) continue;
    came_ = true;
    watched = 1;
    let_the_next_one_kill(signal_.descriptor());
  }
}

}  // namespace stepwright::process

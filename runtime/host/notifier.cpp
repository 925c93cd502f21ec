#include "runtime/host/notifier.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

namespace stepwright::host {

Notifier::Notifier() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

Notifier::~Notifier() {
  if (descriptor_ >= 0) close(descriptor_);
}

void Notifier::notify() {
  const std::uint64_t one = 1;
  // It fails only when the counter is full, and then it is readable anyway.
  [[maybe_unused]] const ssize_t written = write(descriptor_, &one, sizeof one);
}

void Notifier::clear() {
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t taken = read(descriptor_, &count, sizeof count);
}

void Notifier::wait(std::int64_t timeout_ns) {
  pollfd entry{descriptor_, POLLIN, 0};
  const timespec timeout{timeout_ns / 1'000'000'000, timeout_ns % 1'000'000'000};
  ppoll(&entry, 1, timeout_ns < 0 ? nullptr : &timeout, nullptr);
  if ((entry.revents & POLLIN) != 0) clear();
}

}  // namespace stepwright::host

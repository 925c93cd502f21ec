#include "runtime/ground/process/notify_socket.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace stepwright::process {
namespace {

std::optional<long long> number(const char* name) {
  const char* const text = std::getenv(name);
  if (text == nullptr) return std::nullopt;
  char* end = nullptr;
  const long long value = std::strtoll(text, &end, 10);
  return end == text || *end != '\0' ? std::nullopt : std::optional(value);
}

// A line break would begin another assignment.
std::string one_line(std::string_view text) {
  std::string line(text);
  for (char& c : line) c = c == '\n' ? ' ' : c;
  return line;
}

std::string monotonic_usec() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::to_string(static_cast<long long>(now.tv_sec) * 1'000'000 + now.tv_nsec / 1'000);
}

}  // namespace

NotifySocket::NotifySocket() {
  const char* const path = std::getenv("NOTIFY_SOCKET");
  // A path, or '@' and a name that no file has.
  if (path == nullptr || (path[0] != '/' && path[0] != '@')) return;
  if (std::strlen(path) < 2 || std::strlen(path) >= sizeof(sockaddr_un::sun_path)) return;
  descriptor_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  address_ = path;
  if (address_[0] == '@') address_[0] = '\0';
  const auto interval = number("WATCHDOG_USEC");
  const auto pid = number("WATCHDOG_PID");
  if (interval && *interval > 0 && (!pid || *pid == getpid()))
    watchdog_ = std::chrono::microseconds(*interval);
}

NotifySocket::~NotifySocket() {
  if (descriptor_ >= 0) close(descriptor_);
}

// False if there is no room for it now.
bool NotifySocket::sent(const std::string& text) const {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, address_.data(), address_.size());
  const std::size_t size = offsetof(sockaddr_un, sun_path) + address_.size();
  const ssize_t done = sendto(descriptor_, text.data(), text.size(), MSG_NOSIGNAL,
                              reinterpret_cast<const sockaddr*>(&address), static_cast<socklen_t>(size));
  return done >= 0 || (errno != EAGAIN && errno != ENOBUFS);
}

void NotifySocket::send(std::string text) {
  constexpr std::string_view kStatus = "STATUS=";
  if (descriptor_ < 0) return;
  // The newest state only is news.
  const bool outdated = !kept_.empty() && kept_.back().starts_with(kStatus) && text.starts_with(kStatus);
  if (outdated) kept_.pop_back();
  kept_.push_back(std::move(text));
  flush();
}

void NotifySocket::flush() {
  while (!kept_.empty() && sent(kept_.front())) kept_.pop_front();
}

void NotifySocket::ready(std::string_view status) {
  send("READY=1\nSTATUS=" + one_line(status) + (watchdog_ ? "\nWATCHDOG=1" : ""));
}
void NotifySocket::reloading() {
  send("RELOADING=1\nMONOTONIC_USEC=" + monotonic_usec());
}
void NotifySocket::stopping() {
  send("STOPPING=1");
}
void NotifySocket::status(std::string_view text) {
  send("STATUS=" + one_line(text));
}
// It is a sign of life now or never.
void NotifySocket::watchdog() {
  flush();
  if (present() && kept_.empty()) (void)sent("WATCHDOG=1");
}

void Heartbeat::turn() {
  init_.flush();
  const auto interval = init_.watchdog_interval();
  const auto now = std::chrono::steady_clock::now();
  if (!interval || now < due_) return;
  due_ = now + *interval / 4;
  init_.watchdog();
}

}  // namespace stepwright::process

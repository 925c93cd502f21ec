#include "runtime/ground/process/notify_listener.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace stepwright::process {
namespace {

tl::unexpected<result::Diagnostics> unavailable(const char* what) {
  return result::fail("M0014", {}, std::string(what) + ": " + std::strerror(errno));
}

Notice notice_of(std::string_view text, pid_t sender) {
  Notice notice;
  notice.sender = sender;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    constexpr std::string_view kStatus = "STATUS=";
    if (line == "READY=1") notice.ready = true;
    if (line == "WATCHDOG=1") notice.alive = true;
    if (line.starts_with(kStatus)) notice.status = line.substr(kStatus.size());
  }
  return notice;
}

}  // namespace

result::Result<NotifyListener> NotifyListener::open() {
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (descriptor < 0) return unavailable("the system gives no socket");
  NotifyListener listener(descriptor, {});
  const int on = 1;
  if (setsockopt(descriptor, SOL_SOCKET, SO_PASSCRED, &on, sizeof on) != 0)
    return unavailable("the system does not say who sends");
  // The family alone: the system finds an abstract name that nobody has.
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address.sun_family) != 0)
    return unavailable("the system gives no address");
  socklen_t size = sizeof address;
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    return unavailable("the system does not say the address");
  const std::size_t begin = offsetof(sockaddr_un, sun_path) + 1;
  listener.name_ = "@" + std::string(address.sun_path + 1, size - begin);
  return listener;
}

NotifyListener::~NotifyListener() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::vector<Notice> NotifyListener::take() {
  std::vector<Notice> notices;
  while (true) {
    std::array<char, 4'096> text{};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(ucred))> control{};
    iovec part{text.data(), text.size()};
    msghdr message{};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    const ssize_t length = recvmsg(descriptor_, &message, MSG_CMSG_CLOEXEC);
    if (length < 0) return notices;
    const cmsghdr* const head = CMSG_FIRSTHDR(&message);
    if (head == nullptr || head->cmsg_type != SCM_CREDENTIALS) continue;
    ucred sender{};
    std::memcpy(&sender, CMSG_DATA(head), sizeof sender);
    notices.push_back(notice_of({text.data(), static_cast<std::size_t>(length)}, sender.pid));
  }
}

}  // namespace stepwright::process

#include "runtime/service/internal/session.h"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <optional>
#include <utility>

namespace stepwright::service::internal {
namespace {

constexpr std::size_t kReadBytes = 64u << 10;

}  // namespace

Session::Session(std::uint64_t number, Descriptor socket)
    : number_(number), socket_(std::move(socket)), since_(Clock::now()) {
  ucred peer{};
  socklen_t size = sizeof peer;
  if (::getsockopt(socket_.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0) process_ = peer.pid;
}

bool Session::readable() const {
  pollfd entry{socket_.get(), POLLIN, 0};
  return ::poll(&entry, 1, 0) == 1;
}

void Session::read() {
  std::array<std::byte, kReadBytes> buffer;
  const ssize_t count = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
  if (count > 0) {
    in_.append(std::span(buffer).first(static_cast<std::size_t>(count)));
  } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
    closed_ = true;
  }
}

std::optional<Message> Session::next() {
  if (closed_) return std::nullopt;
  auto body = in_.next();
  if (!body) {
    closed_ = true;
    return std::nullopt;
  }
  if (!*body) return std::nullopt;
  auto message = decode(**body);
  if (!message) {
    closed_ = true;
    return std::nullopt;
  }
  return std::move(*message);
}

void Session::send(const Message& message) {
  // Nothing that the runtime makes exceeds a message: images and lists are bounded where they enter.
  try {
    if (closed_ || !encode_frame(message, out_)) return;
  } catch (const std::bad_alloc&) {
    closed_ = true;
  }
  if (out_.size() - sent_ > kMaxUnsent) closed_ = true;
}

void Session::welcome(int snapshot_descriptor) {
  std::vector<std::byte> frame;
  if (!encode_frame(Welcome{}, frame)) return;
  iovec part{frame.data(), frame.size()};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof(int));
  std::memcpy(CMSG_DATA(header), &snapshot_descriptor, sizeof(int));
  // The first bytes on a fresh socket always fit.
  const ssize_t sent = ::sendmsg(socket_.get(), &message, MSG_NOSIGNAL);
  if (sent != static_cast<ssize_t>(frame.size())) closed_ = true;
}

void Session::write() {
  while (sent_ < out_.size() && !closed_) {
    const ssize_t count = ::send(socket_.get(), out_.data() + sent_, out_.size() - sent_, MSG_NOSIGNAL);
    if (count < 0) {
      if (errno == EINTR) continue;
      if (errno != EAGAIN) closed_ = true;
      return;
    }
    sent_ += static_cast<std::size_t>(count);
  }
  out_.clear();
  sent_ = 0;
}

}  // namespace stepwright::service::internal

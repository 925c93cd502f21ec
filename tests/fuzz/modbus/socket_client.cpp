#include "tests/fuzz/modbus/socket_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <string>

namespace stepwright::fuzz::modbus {

namespace {

constexpr std::size_t kHeader = 7;
constexpr std::size_t kMostPdu = 253;

[[noreturn]] void broken(const std::string& what) {
  throw std::runtime_error(what);
}

bool wait_for(int socket, short events, std::chrono::milliseconds patience) {
  pollfd entry{socket, events, 0};
  return ::poll(&entry, 1, static_cast<int>(patience.count())) == 1;
}

}  // namespace

SocketClient::SocketClient(std::uint16_t port, std::chrono::milliseconds patience)
    : port_(port), patience_(patience) {
  connect();
}

SocketClient::~SocketClient() {
  ::close(socket_);
}

void SocketClient::connect() {
  if (socket_ >= 0) {
    ::close(socket_);
    ++reconnections_;
  }
  unread_.clear();
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port_);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    broken("the server takes no connection any more");
  const int on = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

bool SocketClient::send(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const auto sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
      continue;
    }
    const bool full = errno == EAGAIN || errno == EWOULDBLOCK;
    // A server that reads no more is one that waits for us to read.
    if (full && wait_for(socket_, POLLIN | POLLOUT, patience_) && receive(false)) continue;
    if (full) broken("the server takes no bytes any more");
    return false;
  }
  return true;
}

// False when the connection is over.
bool SocketClient::receive(bool wait) {
  if (wait && !wait_for(socket_, POLLIN, patience_)) broken("no answer to a valid request");
  std::array<std::uint8_t, 8192> buffer;
  const auto got = ::recv(socket_, buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (got > 0) {
    unread_.insert(unread_.end(), buffer.begin(), buffer.begin() + got);
    take_frames();
    return true;
  }
  return got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
}

void SocketClient::take_frames() {
  std::size_t at = 0;
  while (unread_.size() - at >= kHeader) {
    const std::size_t length = static_cast<std::size_t>(unread_[at + 4] << 8 | unread_[at + 5]);
    if (unread_[at + 2] != 0 || unread_[at + 3] != 0 || length < 3 || length > kMostPdu + 1)
      broken("the server has sent what is no frame");
    if (unread_.size() - at < 6 + length) break;
    const auto first = unread_.begin() + static_cast<std::ptrdiff_t>(at);
    newest_.assign(first, first + static_cast<std::ptrdiff_t>(6 + length));
    at += 6 + length;
    ++answers_;
    if (newest_[kHeader] < 0x80) continue;
    ++exceptions_;
    if (length != 3) broken("an exception with more than its code");
  }
  unread_.erase(unread_.begin(), unread_.begin() + static_cast<std::ptrdiff_t>(at));
}

void SocketClient::await_answers(std::uint64_t count) {
  for (const std::uint64_t enough = answers_ + count; answers_ < enough;) {
    if (!receive(true)) broken("the server closed a connection on which frames were right");
  }
}

void SocketClient::await_close() {
  while (receive(true)) {
  }
}

Bytes SocketClient::ask(const Bytes& pdu) {
  ++transaction_;
  newest_.clear();
  if (!send(tcp_frame(pdu, transaction_))) broken("the server closed a connection on which all was well");
  while (newest_.empty()) {
    if (!receive(true)) broken("the server closed a connection on which all was well");
  }
  const std::uint16_t transaction = static_cast<std::uint16_t>(newest_[0] << 8 | newest_[1]);
  if (transaction != transaction_) broken("an answer to another request");
  return {newest_.begin() + kHeader, newest_.end()};
}

}  // namespace stepwright::fuzz::modbus

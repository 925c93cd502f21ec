#include "firmware/boards/host/tcp_line.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "runtime/modbus/pdu/serve.h"
#include "runtime/modbus/pdu/tcp_frame.h"

namespace stepwright::boards {
namespace {

namespace pdu = modbus::pdu;

bool watched(int waits, int descriptor) {
  epoll_event event{};
  event.events = EPOLLIN;
  return ::epoll_ctl(waits, EPOLL_CTL_ADD, descriptor, &event) == 0;
}

}  // namespace

TcpLine::TcpLine(std::uint16_t port) : waits_(::epoll_create1(EPOLL_CLOEXEC)) {
  if (waits_ < 0 || open(port)) return;
  ::close(std::exchange(waits_, -1));
}

TcpLine::~TcpLine() {
  if (peer_ >= 0) ::close(peer_);
  if (listener_ >= 0) ::close(listener_);
  if (waits_ >= 0) ::close(waits_);
}

bool TcpLine::open(std::uint16_t port) {
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
         ::listen(listener_, 4) == 0 && watched(waits_, listener_);
}

std::string TcpLine::name() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
  return "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
}

bool TcpLine::work(pdu::DataModel& model) {
  const bool greeted = greet();
  return (peer_ >= 0 && serve(model)) || greeted;
}

bool TcpLine::greet() {
  const int fresh = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (fresh < 0) return false;
  hang_up();
  const int on = 1;
  ::setsockopt(fresh, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  peer_ = fresh;
  if (!watched(waits_, peer_)) hang_up();
  return true;
}

bool TcpLine::serve(pdu::DataModel& model) {
  std::array<std::byte, pdu::kMaxTcpRequest> bytes;
  const ssize_t count = ::recv(peer_, bytes.data(), bytes.size(), 0);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  if (count <= 0) return hang_up(), true;
  held_.insert(held_.end(), bytes.begin(), bytes.begin() + count);
  for (;;) {
    const pdu::TcpTake take = pdu::take_frame(held_);
    if (take.state == pdu::TcpTake::State::NeedsMore) return true;
    if (take.state == pdu::TcpTake::State::Bad) return hang_up(), true;
    std::array<std::byte, pdu::kMaxTcpFrame> out;
    const std::size_t length = pdu::serve(model, take.frame.pdu, pdu::tcp_pdu(out));
    const std::size_t size = pdu::seal_tcp(out, take.frame.transaction, take.frame.unit, length);
    // One answer always has room in the socket of a master that reads its answers.
    if (::send(peer_, out.data(), size, MSG_NOSIGNAL) != static_cast<ssize_t>(size)) return hang_up(), true;
    held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(take.frame.bytes));
  }
}

// A closed descriptor leaves the epoll by itself.
void TcpLine::hang_up() {
  if (peer_ >= 0) ::close(peer_);
  peer_ = -1;
  held_.clear();
}

}  // namespace stepwright::boards

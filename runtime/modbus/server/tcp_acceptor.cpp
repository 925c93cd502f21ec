#include "runtime/modbus/server/tcp_acceptor.h"

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace stepwright::modbus::server {
namespace {

constexpr int kBacklog = 1'024;

int spare_descriptor() {
  return ::open("/dev/null", O_RDONLY | O_CLOEXEC);
}

void set(int socket, int level, int option, int value) {
  setsockopt(socket, level, option, &value, sizeof value);
}

// Small requests and answers must not wait for each other, and who is gone without a word must be noticed.
void prepare(int socket, int keep_alive_s) {
  set(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  set(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(socket, IPPROTO_TCP, TCP_KEEPIDLE, keep_alive_s);
  set(socket, IPPROTO_TCP, TCP_KEEPINTVL, std::max(1, keep_alive_s / 3));
  set(socket, IPPROTO_TCP, TCP_KEEPCNT, 3);
}

network::IpAddress address_of(const sockaddr_storage& from) {
  network::IpAddress address{};
  if (from.ss_family == AF_INET6) {
    const auto& v6 = reinterpret_cast<const sockaddr_in6&>(from);
    std::memcpy(address.data(), &v6.sin6_addr, address.size());
    return address;
  }
  const auto& v4 = reinterpret_cast<const sockaddr_in&>(from);
  address[10] = address[11] = 0xFF;
  std::memcpy(address.data() + 12, &v4.sin_addr, 4);
  return address;
}

class TcpTransport final : public Transport {
 public:
  TcpTransport(int socket, std::string address) : socket_(socket), peer_{std::move(address), {}, false} {}
  ~TcpTransport() override { close(socket_); }

  int descriptor() const override { return socket_; }
  Moved read(std::span<std::byte> into) override {
    return moved(::recv(socket_, into.data(), into.size(), 0), true);
  }
  Moved write(std::span<const std::byte> from) override {
    return moved(::send(socket_, from.data(), from.size(), MSG_NOSIGNAL), false);
  }
  const Peer* peer() const override { return &peer_; }

 private:
  static Moved moved(ssize_t count, bool reading) {
    if (count > 0) return {Moved::State::Done, static_cast<std::size_t>(count)};
    const bool later = count < 0 && (errno == EAGAIN || errno == EINTR);
    return {later || (count == 0 && !reading) ? Moved::State::WouldBlock : Moved::State::Closed, 0};
  }
  int socket_;
  Peer peer_;
};

socklen_t socket_address(const network::IpAddress& ip, bool v4, std::uint16_t port, sockaddr_storage& out) {
  if (v4) {
    auto& address = reinterpret_cast<sockaddr_in&>(out);
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    std::memcpy(&address.sin_addr, ip.data() + 12, 4);
    return sizeof address;
  }
  auto& address = reinterpret_cast<sockaddr_in6&>(out);
  address.sin6_family = AF_INET6;
  address.sin6_port = htons(port);
  std::memcpy(&address.sin6_addr, ip.data(), ip.size());
  return sizeof address;
}

}  // namespace

result::Result<Listener> Listener::open(const TcpOptions& options) {
  const std::string place = options.bind + " port " + std::to_string(options.port);
  const auto ip = network::parse_ip(options.bind);
  if (!ip) return result::fail("R0102", {}, "`" + options.bind + "` is no address", "127.0.0.1, or ::1");
  const bool v4 = options.bind.find(':') == std::string::npos;
  sockaddr_storage address{};
  const socklen_t size = socket_address(*ip, v4, options.port, address);
  const int socket = ::socket(v4 ? AF_INET : AF_INET6, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  set(socket, SOL_SOCKET, SO_REUSEADDR, 1);
  socklen_t bound = sizeof address;
  if (socket < 0 || ::bind(socket, reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      ::listen(socket, kBacklog) != 0 ||
      ::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &bound) != 0) {
    const int error = errno;
    if (socket >= 0) close(socket);
    return result::fail(
        "R0102", {}, "cannot listen on " + place + ": " + std::strerror(error),
        error == EACCES ? "ports below 1024 need CAP_NET_BIND_SERVICE, or take another port" : "");
  }
  // Both kinds of addresses have their port at the same place.
  const std::uint16_t port = ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
  return Listener(socket, port, options);
}

Listener::Listener(int socket, std::uint16_t port, TcpOptions options)
    : socket_(socket), spare_(spare_descriptor()), port_(port), options_(std::move(options)) {}

Listener::Listener(Listener&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      spare_(std::exchange(other.spare_, -1)),
      port_(other.port_),
      refused_(other.refused_),
      options_(std::move(other.options_)) {}

Listener::~Listener() {
  if (socket_ >= 0) close(socket_);
  if (spare_ >= 0) close(spare_);
}

int Listener::accept_one(network::IpAddress& address) {
  sockaddr_storage from{};
  socklen_t size = sizeof from;
  const int socket =
      ::accept4(socket_, reinterpret_cast<sockaddr*>(&from), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (socket >= 0) address = address_of(from);
  return socket;
}

int Listener::accept(std::string& address) {
  for (int refused = 0; refused < kMostRefused; ++refused) {
    network::IpAddress from{};
    const int socket = accept_one(from);
    if (socket < 0) {
      if (errno != EMFILE && errno != ENFILE) return -1;
      ++refused_;
      turn_away();
      return -1;
    }
    const bool allowed = std::any_of(options_.allow.begin(), options_.allow.end(),
                                     [&](const network::IpRange& range) { return range.contains(from); });
    if (allowed) {
      prepare(socket, options_.keep_alive_s);
      address = network::to_string(from);
      return socket;
    }
    close(socket);
    ++refused_;
  }
  return -1;
}

void Listener::turn_away() {
  if (spare_ >= 0) close(spare_);
  network::IpAddress from{};
  const int socket = accept_one(from);
  if (socket >= 0) close(socket);
  spare_ = spare_descriptor();
}

result::Result<std::unique_ptr<TcpAcceptor>> TcpAcceptor::open(const TcpOptions& options) {
  auto listener = Listener::open(options);
  if (!listener) return result::forward(listener);
  const bool v6 = options.bind.find(':') != std::string::npos;
  const std::string name =
      "tcp " + (v6 ? "[" + options.bind + "]" : options.bind) + ":" + std::to_string(listener->port());
  return std::unique_ptr<TcpAcceptor>(new TcpAcceptor(std::move(*listener), name));
}

std::unique_ptr<Transport> TcpAcceptor::admit() {
  std::string address;
  const int socket = listener_.accept(address);
  if (socket < 0) return nullptr;
  return std::make_unique<TcpTransport>(socket, std::move(address));
}

}  // namespace stepwright::modbus::server

#include "tests/support/modbus_slave/cut_proxy.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <vector>

namespace stepwright::support {
namespace {

sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

void without_delay(int descriptor) {
  const int on = 1;
  setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

}  // namespace

CutProxy::CutProxy(std::uint16_t target) : target_(target) {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address = loopback(0);
  socklen_t length = sizeof address;
  bind(listener_, reinterpret_cast<sockaddr*>(&address), length);
  listen(listener_, 64);
  getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { carry(); });
}

CutProxy::~CutProxy() {
  stop_ = true;
  thread_.join();
  reset();
  close(listener_);
}

void CutProxy::close_with_reset(const Pair& pair) {
  const linger reset{1, 0};
  for (const int end : {pair.client, pair.server}) {
    setsockopt(end, SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
    close(end);
  }
}

void CutProxy::reset() {
  const std::scoped_lock lock(mutex_);
  for (const Pair& pair : pairs_) close_with_reset(pair);
  pairs_.clear();
}

void CutProxy::freeze() {
  const std::scoped_lock lock(mutex_);
  for (Pair& pair : pairs_) pair.frozen = true;
}

void CutProxy::accept_one() {
  const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  if (client < 0) return;
  ++accepted_;
  const int server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = loopback(target_);
  if (connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    close_with_reset({client, server, false});
    return;
  }
  without_delay(client);
  without_delay(server);
  pairs_.push_back({client, server, false});
}

bool CutProxy::move(int from, int to) {
  std::array<std::byte, 1'024> bytes;
  const ssize_t got = recv(from, bytes.data(), bytes.size(), MSG_DONTWAIT);
  return got > 0 && send(to, bytes.data(), static_cast<std::size_t>(got), MSG_NOSIGNAL) == got;
}

void CutProxy::carry() {
  while (!stop_) {
    std::vector<pollfd> entries{{listener_, POLLIN, 0}};
    {
      const std::scoped_lock lock(mutex_);
      for (const Pair& pair : pairs_) {
        if (pair.frozen) continue;
        entries.push_back({pair.client, POLLIN, 0});
        entries.push_back({pair.server, POLLIN, 0});
      }
    }
    if (poll(entries.data(), entries.size(), 2) <= 0) continue;
    const std::scoped_lock lock(mutex_);
    if (entries[0].revents != 0) accept_one();
    for (auto pair = pairs_.begin(); pair != pairs_.end();) {
      bool alive = true;
      for (const pollfd& entry : entries) {
        if (entry.revents == 0 || pair->frozen) continue;
        if (entry.fd == pair->client) alive = alive && move(pair->client, pair->server);
        if (entry.fd == pair->server) alive = alive && move(pair->server, pair->client);
      }
      if (!alive) close_with_reset(*pair);
      pair = alive ? std::next(pair) : pairs_.erase(pair);
    }
  }
}

}  // namespace stepwright::support

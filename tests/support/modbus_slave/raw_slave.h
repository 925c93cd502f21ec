#pragma once

// A slave of a test at the level of bytes: one connection after the other, each request answered as the test
// says, with whatever a frame may not have.
//
//   RawSlave slave([](int client, const RawSlave::Bytes& request) { say(client, {...}); });
//
// Threads: its own serves, and calls the answer.

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace stepwright::support {

class RawSlave {
 public:
  using Bytes = std::vector<std::uint8_t>;
  using Answer = std::function<void(int client, const Bytes& request)>;

  explicit RawSlave(Answer answer) : answer_(std::move(answer)) {
    listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    bind(listener_, reinterpret_cast<sockaddr*>(&address), length);
    listen(listener_, 4);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] { serve(); });
  }
  ~RawSlave() {
    shutdown(listener_, SHUT_RDWR);
    thread_.join();
    close(listener_);
  }
  RawSlave(const RawSlave&) = delete;
  RawSlave& operator=(const RawSlave&) = delete;
  std::uint16_t port() const { return port_; }
  int connections() const { return connections_; }
  int requests() const { return requests_; }

 private:
  void serve() {
    while (true) {
      const int client = accept(listener_, nullptr, nullptr);
      if (client < 0) return;
      ++connections_;
      Bytes request(300);
      while (true) {
        const ssize_t got = recv(client, request.data(), request.size(), 0);
        if (got <= 0) break;
        ++requests_;
        answer_(client, Bytes(request.begin(), request.begin() + got));
      }
      close(client);
    }
  }

  Answer answer_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<int> connections_{0};
  std::atomic<int> requests_{0};
  std::thread thread_;
};

inline void say(int client, const RawSlave::Bytes& bytes) {
  static_cast<void>(send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL));
}

}  // namespace stepwright::support

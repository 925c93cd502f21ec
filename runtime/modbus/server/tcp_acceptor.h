#pragma once

// Modbus TCP: a listening socket and its clients.
// Threads: the server's.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/network/ip_range.h"
#include "runtime/ground/result/result.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

struct TcpOptions {
  std::string bind = "127.0.0.1";       // an address of this machine; "::" or "0.0.0.0": all
  std::uint16_t port = 502;             // 0: any free one
  std::vector<network::IpRange> allow;  // who may come in; nobody else
  int keep_alive_s =
      10;  // after so long without a byte, and every third of it then, it is asked for a sign of life
};

// A socket that takes connections. For acceptors of other protocols over TCP too.
class Listener {
 public:
  // Fails with R0102: the address is none, is not of this machine, or is taken; the port is reserved.
  [[nodiscard]] static result::Result<Listener> open(const TcpOptions& options);
  Listener(Listener&& other) noexcept;
  Listener& operator=(Listener&&) = delete;
  ~Listener();

  int descriptor() const { return socket_; }
  std::uint16_t port() const { return port_; }

  // A connection that is allowed in, non-blocking, without delays, with keep-alive; -1: nobody is there, or
  // kMostRefused were there that may not come in.
  // `address` says where it comes from. The caller owns the descriptor.
  int accept(std::string& address);
  // Closes one connection that waits.
  void turn_away();
  // Of accept(), since the last call.
  std::uint64_t take_refused() { return std::exchange(refused_, 0); }

  static constexpr int kMostRefused = 32;

 private:
  Listener(int socket, std::uint16_t port, TcpOptions options);
  int accept_one(network::IpAddress& address);

  int socket_;
  int spare_;  // a descriptor to give up when there are no others, so that a connection can be taken and
               // closed
  std::uint16_t port_;
  std::uint64_t refused_ = 0;
  TcpOptions options_;
};

class TcpAcceptor final : public Acceptor {
 public:
  [[nodiscard]] static result::Result<std::unique_ptr<TcpAcceptor>> open(const TcpOptions& options);

  int descriptor() const override { return listener_.descriptor(); }
  std::unique_ptr<Transport> admit() override;
  void turn_away() override { listener_.turn_away(); }
  std::uint64_t take_refused() override { return listener_.take_refused(); }
  std::string name() const override { return name_; }
  std::uint16_t port() const { return listener_.port(); }

 private:
  TcpAcceptor(Listener listener, std::string name) : listener_(std::move(listener)), name_(std::move(name)) {}
  Listener listener_;
  std::string name_;
};

}  // namespace stepwright::modbus::server

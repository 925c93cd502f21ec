#pragma once

// The server: one epoll loop over acceptors, sessions and the controller's answers. It never waits for any of
// them.
//
//   auto server = Server::create(options, data);
//   (*server)->add(std::move(*TcpAcceptor::open({...})));
//   while (!stop.came()) (*server)->run_for(100ms);
//
// Thread rule: everything on one thread. Invariants: at most max_connections sessions, each with the buffers
// of its Session and nothing else; what one client does or fails to do costs the others the time of its own
// requests only.

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/modbus/server/options.h"
#include "runtime/modbus/server/process_data.h"
#include "runtime/modbus/server/session.h"
#include "runtime/modbus/server/transport.h"

namespace stepwright::modbus::server {

class Server {
 public:
  // `data` must outlive the server. Fails with R0101: the system gives no descriptors.
  [[nodiscard]] static result::Result<std::unique_ptr<Server>> create(ServerOptions options,
                                                                      ProcessData& data);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  void add(std::unique_ptr<Acceptor> acceptor);
  // A descriptor that ends a turn's wait when it becomes readable; nothing else happens with it.
  void watch(int descriptor);

  // Waits for something to do, at most `timeout`, and does it.
  void turn(std::chrono::milliseconds timeout);
  // Turns until so much time has passed or a watched descriptor is readable.
  void run_for(std::chrono::milliseconds time);

  const ServerFigures& figures() const { return figures_; }

 private:
  struct Visitor {
    std::unique_ptr<Session> session;
    std::uint32_t events = 0;  // that epoll looks for
    std::string address;       // under which it is counted
  };
  class Identity final : public pdu::Identity {
   public:
    explicit Identity(const ServerOptions& options) : options_(options) {}
    std::span<const std::byte> identification(std::uint8_t object) const override;

   private:
    const ServerOptions& options_;
  };

  Server(ServerOptions options, ProcessData& data, int epoll);
  void admit(Acceptor& acceptor);
  void enter(std::unique_ptr<Transport> transport);
  void serve(std::uint64_t key, std::uint32_t events);
  void take_written();
  void settle(Visitor& visitor);
  void leave(std::uint64_t ticket);
  void check_all();

  ServerOptions options_;
  ProcessData& data_;
  Access access_;
  Identity identity_;
  ServerFigures figures_;
  Shared shared_;
  int epoll_;
  Clock::time_point now_;
  Clock::time_point next_check_;
  bool interrupted_ = false;  // a watched descriptor is readable
  std::uint64_t last_ticket_ = 0;
  std::vector<std::unique_ptr<Acceptor>> acceptors_;  // outlive the sessions
  std::vector<Visitor> visitors_;                     // by slot
  std::vector<std::size_t> free_;                     // slots
  std::map<std::string, std::size_t, std::less<>> by_address_;
};

}  // namespace stepwright::modbus::server

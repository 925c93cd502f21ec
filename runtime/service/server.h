#pragma once

// The service of a runtime: a Unix domain socket for several clients, one event loop.
//
//   auto server = Server::create({socket_path, 1s}, *runtime);
//   (*server)->run(stop_descriptor);          // until that descriptor is readable
//
// Threads: the one that uses the RuntimePort. Invariants: no client can make it block, grow without bound or
// stop, nor keep others out: however many connections one process opens, there is room for a client of
// another process and for its commands; a lack of memory costs only the request or its connection. A
// malformed message ends the connection that it came from. Clients of the same user only (mode 0600).

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "runtime/ground/result/result.h"
#include "runtime/host/runtime_port.h"
#include "runtime/service/program_persistence.h"
#include "runtime/service/service_observer.h"

namespace stepwright::service {

struct ServerConfig {
  std::filesystem::path socket{};  // in a folder that exists
  // After the last sign of life of a supervisor the runtime's policy applies.
  std::chrono::milliseconds supervisor_lost_after{1'000};
  std::string version = {};             // of the program, for its status
  ServiceObserver* observer = nullptr;  // told of everything that happens; outlives the server
  // Null: programs are not kept for the next start. Outlives the server.
  ProgramPersistence* persistence = nullptr;
  // Within this time a connection says hello, or its place is another's.
  std::chrono::milliseconds greeting_within{2'000};
};

class Server {
 public:
  // Binds the socket; fails with R0001, for example when another runtime serves it.
  [[nodiscard]] static result::Result<std::unique_ptr<Server>> create(const ServerConfig& config,
                                                                      host::RuntimePort& port);
  ~Server();

  // Serves until `stop_descriptor` is readable.
  void run(int stop_descriptor);
  // One turn: waits for something to do, at most `timeout`, and does it.
  void turn(std::chrono::milliseconds timeout, int stop_descriptor = -1);
  // From now on.
  void set_supervisor_lost_after(std::chrono::milliseconds lost_after);

 private:
  struct State;
  explicit Server(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::service

#pragma once

// Clients for a Modbus TCP server: each has one request under way and sends the next when its answer is
// there. All of one measurement run in one process of their own, in one epoll loop; the same for every
// server.

#include <sys/types.h>

#include <cstdint>

namespace stepwright::bench {

struct Load {
  std::uint16_t port = 0;
  int clients = 1;
  double seconds = 1.0;
  std::uint16_t first = 0;       // holding registers
  std::uint16_t registers = 10;  // of each read
};

struct Served {
  double requests_per_s = 0.0;
  double p50_us = 0.0;
  double p99_us = 0.0;
  std::uint64_t wrong = 0;  // answers that are none to what was asked
};

// The process of the clients. Begin it before any thread exists.
class LoadProcess {
 public:
  LoadProcess();
  ~LoadProcess();
  LoadProcess(const LoadProcess&) = delete;
  LoadProcess& operator=(const LoadProcess&) = delete;

  // Ends this process with a message if the clients cannot connect.
  Served run(const Load& load);

 private:
  pid_t child_ = -1;
  int to_ = -1;
  int from_ = -1;
};

}  // namespace stepwright::bench

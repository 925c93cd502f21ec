#pragma once

// A server to compare with, in a process of its own.

#include <sys/types.h>

#include <cstdint>

namespace stepwright::bench {

// Killed with the object. Make it before any thread exists. Ends this process with a message if it cannot
// listen.
class ServerProcess {
 public:
  // `serve` gets a listening socket of the loopback interface and does not return.
  explicit ServerProcess(void (*serve)(int listener));
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;
  std::uint16_t port() const { return port_; }

 private:
  pid_t child_ = -1;
  std::uint16_t port_ = 0;
};

// The next client at the listener, its small answers sent at once; below 0: none.
int accept_client(int listener);

}  // namespace stepwright::bench

#pragma once

// The baseline: libmodbus's own way to serve many clients (its example bandwidth-server-many-up.c: one
// thread, select, modbus_receive, modbus_reply), with the map of OpenPLC's size, TCP_NODELAY on every
// connection and no debug output.

#include <sys/types.h>

#include <cstdint>

namespace stepwright::bench {

// A process of its own; killed with the object. Make it before any thread exists.
class LibmodbusServer {
 public:
  LibmodbusServer();
  ~LibmodbusServer();
  LibmodbusServer(const LibmodbusServer&) = delete;
  LibmodbusServer& operator=(const LibmodbusServer&) = delete;
  std::uint16_t port() const { return port_; }

 private:
  pid_t child_ = -1;
  std::uint16_t port_ = 0;
};

}  // namespace stepwright::bench

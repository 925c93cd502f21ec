#pragma once

// A TCP connection within a time, set up for short requests and answers. Any thread.

#include <chrono>

#include "runtime/modbus/master/endpoint.h"

namespace stepwright::modbus::master {

struct ConnectedSocket {
  int descriptor = -1;  // of the caller; not blocking, TCP_NODELAY, closed at exec
  int error = 0;        // errno where there is no descriptor
};

// Tries every address of the host until the time is over. A peer that is gone without a word is noticed after
// `peer_timeout`: by what it does not acknowledge (TCP_USER_TIMEOUT), and when idle by keepalive probes.
ConnectedSocket connect_tcp(const TcpEndpoint& endpoint, std::chrono::milliseconds timeout,
                            std::chrono::milliseconds peer_timeout);

}  // namespace stepwright::modbus::master

#include "runtime/modbus/master/tcp_connect.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <string>

namespace stepwright::modbus::master {
namespace {

using Clock = std::chrono::steady_clock;
using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

int error_of_lookup(int code) {
  return code == EAI_SYSTEM ? errno : code == EAI_MEMORY ? ENOMEM : EHOSTUNREACH;
}

void set_options(int descriptor, std::chrono::milliseconds peer_timeout) {
  const auto set = [descriptor](int level, int name, int value) {
    static_cast<void>(
        setsockopt(descriptor, level, name, &value, sizeof value));  // a refusal costs speed only
  };
  set(IPPROTO_TCP, TCP_NODELAY, 1);
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, 1);
  set(IPPROTO_TCP, TCP_KEEPINTVL, 1);
  set(IPPROTO_TCP, TCP_KEEPCNT, 2);
  set(IPPROTO_TCP, TCP_USER_TIMEOUT, static_cast<int>(peer_timeout.count()));
}

// 0, or why the connection did not come about by the deadline.
int finish_connect(int descriptor, const addrinfo& address, Clock::time_point deadline) {
  if (connect(descriptor, address.ai_addr, address.ai_addrlen) == 0) return 0;
  if (errno != EINPROGRESS) return errno;
  pollfd entry{descriptor, POLLOUT, 0};
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    const int ready = poll(&entry, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (ready < 0 && errno == EINTR) continue;
    if (ready < 0) return errno;
    if (ready == 0) return ETIMEDOUT;
    int error = 0;
    socklen_t length = sizeof error;
    getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &length);
    return error;
  }
}

}  // namespace

ConnectedSocket connect_tcp(const TcpEndpoint& endpoint, std::chrono::milliseconds timeout,
                            std::chrono::milliseconds peer_timeout) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(endpoint.port);
  if (const int code = getaddrinfo(endpoint.host.c_str(), port.c_str(), &wanted, &found); code != 0)
    return {-1, error_of_lookup(code)};
  const Addresses addresses(found, &freeaddrinfo);
  const auto deadline = Clock::now() + timeout;
  int error = EHOSTUNREACH;
  for (const addrinfo* address = addresses.get(); address != nullptr; address = address->ai_next) {
    const int descriptor =
        socket(address->ai_family, address->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, address->ai_protocol);
    if (descriptor < 0) {
      error = errno;
      continue;
    }
    // libmodbus waits with select, whose sets end here.
    error = descriptor >= FD_SETSIZE ? EMFILE : finish_connect(descriptor, *address, deadline);
    if (error == 0) {
      set_options(descriptor, peer_timeout);
      return {descriptor, 0};
    }
    close(descriptor);
  }
  return {-1, error};
}

}  // namespace stepwright::modbus::master

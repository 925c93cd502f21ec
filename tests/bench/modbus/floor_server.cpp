#include "tests/bench/modbus/floor_server.h"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "tests/bench/modbus/server_process.h"

namespace stepwright::bench {
namespace {

void watch(int epoll, int descriptor) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = descriptor;
  epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &event);
}

void answer(int client) {
  std::array<unsigned char, 260> query;
  std::array<unsigned char, 29> reply{0, 0, 0, 0, 0, 23, 1, 3, 20};
  if (recv(client, query.data(), query.size(), MSG_DONTWAIT) < 2) {
    close(client);
    return;
  }
  reply[0] = query[0];
  reply[1] = query[1];
  if (send(client, reply.data(), reply.size(), MSG_NOSIGNAL) < 0) close(client);
}

}  // namespace

void serve_a_constant(int listener) {
  const int epoll = epoll_create1(EPOLL_CLOEXEC);
  watch(epoll, listener);
  std::array<epoll_event, 64> events;
  while (true) {
    const int count = epoll_wait(epoll, events.data(), static_cast<int>(events.size()), -1);
    if (count < 0) std::exit(5);
    for (int i = 0; i < count; ++i) {
      const int descriptor = events[static_cast<std::size_t>(i)].data.fd;
      if (descriptor != listener) {
        answer(descriptor);
      } else if (const int client = accept_client(listener); client >= 0) {
        watch(epoll, client);
      }
    }
  }
}

}  // namespace stepwright::bench

#include "tests/bench/modbus/libmodbus_server.h"

#include <modbus/modbus.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <signal.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace stepwright::bench {
namespace {

[[noreturn]] void serve(int listener) {
  modbus_t* const context = modbus_new_tcp("127.0.0.1", 0);
  modbus_mapping_t* const map = modbus_mapping_new(8'192, 8'192, 8'192, 1'024);
  fd_set all;
  FD_ZERO(&all);
  FD_SET(listener, &all);
  int highest = listener;
  std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> query{};
  while (true) {
    fd_set ready = all;
    if (select(highest + 1, &ready, nullptr, nullptr, nullptr) < 0) std::exit(5);
    for (int fd = 0; fd <= highest; ++fd) {
      if (!FD_ISSET(fd, &ready)) continue;
      if (fd == listener) {
        const int client = accept(listener, nullptr, nullptr);
        if (client < 0) continue;
        const int one = 1;
        setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
        FD_SET(client, &all);
        highest = std::max(highest, client);
        continue;
      }
      modbus_set_socket(context, fd);
      const int count = modbus_receive(context, query.data());
      if (count > 0) {
        modbus_reply(context, query.data(), count, map);
      } else if (count < 0) {
        close(fd);
        FD_CLR(fd, &all);
      }
    }
  }
}

}  // namespace

LibmodbusServer::LibmodbusServer() {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(listener, reinterpret_cast<const sockaddr*>(&address), size) != 0 || listen(listener, 64) != 0 ||
      getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    std::fputs("bench_modbus: libmodbus's server cannot listen\n", stderr);
    std::exit(5);
  }
  port_ = ntohs(address.sin_port);
  child_ = fork();
  if (child_ == 0) serve(listener);
  close(listener);
}

LibmodbusServer::~LibmodbusServer() {
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

}  // namespace stepwright::bench

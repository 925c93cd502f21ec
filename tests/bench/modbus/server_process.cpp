#include "tests/bench/modbus/server_process.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace stepwright::bench {

ServerProcess::ServerProcess(void (*serve)(int listener)) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (bind(listener, reinterpret_cast<const sockaddr*>(&address), size) != 0 || listen(listener, 64) != 0 ||
      getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    std::fputs("bench_modbus: a server to compare with cannot listen\n", stderr);
    std::exit(5);
  }
  port_ = ntohs(address.sin_port);
  child_ = fork();
  if (child_ == 0) {
    serve(listener);
    std::_Exit(5);
  }
  close(listener);
}

ServerProcess::~ServerProcess() {
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

int accept_client(int listener) {
  const int client = accept(listener, nullptr, nullptr);
  const int one = 1;
  if (client >= 0) setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
  return client;
}

}  // namespace stepwright::bench

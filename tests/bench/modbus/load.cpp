#include "tests/bench/modbus/load.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Client {
  int socket = -1;
  std::uint16_t transaction = 0;
  std::size_t received = 0;
  Clock::time_point sent;
  std::array<unsigned char, 300> answer{};
};

int connected(std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) return -1;
  const int one = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
  return socket;
}

void ask(Client& client, const Load& load) {
  ++client.transaction;
  const auto byte = [](unsigned value) { return static_cast<unsigned char>(value & 0xFF); };
  const std::array<unsigned char, 12> request{byte(client.transaction >> 8u),
                                              byte(client.transaction),
                                              0,
                                              0,
                                              0,
                                              6,
                                              1,
                                              3,
                                              byte(load.first >> 8u),
                                              byte(load.first),
                                              byte(load.registers >> 8u),
                                              byte(load.registers)};
  client.received = 0;
  client.sent = Clock::now();
  if (::send(client.socket, request.data(), request.size(), MSG_NOSIGNAL) !=
      static_cast<ssize_t>(request.size()))
    std::exit(5);
}

// What came of the answer; true once it is whole.
bool receive(Client& client, const Load& load, std::uint64_t& wrong) {
  const std::size_t size = 9 + load.registers * 2u;
  const ssize_t count =
      ::recv(client.socket, client.answer.data() + client.received, size - client.received, 0);
  if (count <= 0) std::exit(5);
  client.received += static_cast<std::size_t>(count);
  if (client.received < size) return false;
  const auto& answer = client.answer;
  const bool right = answer[0] == client.transaction >> 8 && answer[1] == (client.transaction & 0xFF) &&
                     answer[7] == 3 && answer[8] == load.registers * 2;
  wrong += right ? 0 : 1;
  return true;
}

Served measure(const Load& load) {
  std::vector<Client> clients(static_cast<std::size_t>(load.clients));
  const int epoll = epoll_create1(EPOLL_CLOEXEC);
  for (std::size_t i = 0; i < clients.size(); ++i) {
    clients[i].socket = connected(load.port);
    if (clients[i].socket < 0) return {};
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = i;
    epoll_ctl(epoll, EPOLL_CTL_ADD, clients[i].socket, &event);
  }
  std::vector<float> times_us;
  times_us.reserve(1'000'000);
  Served served;
  const auto warm = Clock::now() + std::chrono::milliseconds(100);
  const auto end =
      warm + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(load.seconds));
  for (Client& client : clients) ask(client, load);
  std::array<epoll_event, 64> events;
  auto now = Clock::now();
  while (now < end) {
    const int count = epoll_wait(epoll, events.data(), static_cast<int>(events.size()), 1'000);
    for (int i = 0; i < count; ++i) {
      Client& client = clients[events[static_cast<std::size_t>(i)].data.u64];
      if (!receive(client, load, served.wrong)) continue;
      now = Clock::now();
      if (now >= warm)
        times_us.push_back(std::chrono::duration<float, std::micro>(now - client.sent).count());
      ask(client, load);
    }
    if (count <= 0) now = Clock::now();
  }
  for (const Client& client : clients) close(client.socket);
  close(epoll);
  if (times_us.empty()) return served;
  std::sort(times_us.begin(), times_us.end());
  const auto at = [&](double part) {
    return double{times_us[static_cast<std::size_t>(part * double(times_us.size() - 1))]};
  };
  served.requests_per_s = static_cast<double>(times_us.size()) / load.seconds;
  served.p50_us = at(0.5);
  served.p99_us = at(0.99);
  return served;
}

}  // namespace

LoadProcess::LoadProcess() {
  std::array<int, 2> down{};
  std::array<int, 2> up{};
  if (pipe(down.data()) != 0 || pipe(up.data()) != 0) std::exit(5);
  child_ = fork();
  if (child_ == 0) {
    close(down[1]);
    close(up[0]);
    Load load;
    while (read(down[0], &load, sizeof load) == static_cast<ssize_t>(sizeof load)) {
      const Served served = measure(load);
      if (write(up[1], &served, sizeof served) != static_cast<ssize_t>(sizeof served)) break;
    }
    _exit(0);
  }
  close(down[0]);
  close(up[1]);
  to_ = down[1];
  from_ = up[0];
}

LoadProcess::~LoadProcess() {
  close(to_);
  close(from_);
  waitpid(child_, nullptr, 0);
}

Served LoadProcess::run(const Load& load) {
  Served served;
  const bool asked = write(to_, &load, sizeof load) == static_cast<ssize_t>(sizeof load);
  if (!asked || read(from_, &served, sizeof served) != static_cast<ssize_t>(sizeof served) ||
      served.requests_per_s == 0.0) {
    std::fputs("bench_modbus: the clients got no answers\n", stderr);
    std::exit(5);
  }
  return served;
}

}  // namespace stepwright::bench

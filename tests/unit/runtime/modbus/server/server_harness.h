#pragma once

// A server with tables of the test's own, on a thread of its own, and clients that speak bytes.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "runtime/host/notifier.h"
#include "runtime/modbus/pdu/wire.h"
#include "runtime/modbus/server/server.h"
#include "runtime/modbus/server/tcp_acceptor.h"
#include "tests/unit/runtime/modbus/pdu/table_model.h"

namespace stepwright::modbus::server {

using pdu::bytes;
using pdu::Bytes;
using pdu::hex;
using namespace std::chrono_literals;

// Holding registers 0 to 299; writes are done when the test says so, or at once.
class TableData final : public ProcessData {
 public:
  pdu::Exception read(const pdu::Request& request, std::span<std::byte> table) override {
    if (away) return pdu::Exception::DeviceFailure;
    if (request.reads_bits())
      return tables.read_bits(pdu::BitTable::Coils, request.address, request.count, table);
    return tables.read_registers(pdu::RegisterTable::Holding, request.address, request.count, table);
  }
  pdu::Exception begin_write(std::uint64_t ticket, const pdu::Request& request) override {
    if (away) return pdu::Exception::DeviceFailure;
    const pdu::Exception exception =
        request.writes_bits() ? tables.write_coils(request.address, request.count, request.data)
                              : tables.write_registers(request.address, request.count, request.data);
    if (exception != pdu::Exception::None) return exception;
    const std::lock_guard lock(mutex_);
    begun_.push_back({ticket, pdu::Exception::None});
    ++begun;
    if (at_once) notifier_.notify();
    return exception;
  }
  std::optional<Written> take_written() override {
    const std::lock_guard lock(mutex_);
    if (begun_.empty() || (!at_once && allowed_ == 0)) return std::nullopt;
    if (!at_once) --allowed_;
    const Written written = begun_.front();
    begun_.pop_front();
    return written;
  }
  int descriptor() const override { return notifier_.descriptor(); }
  void clear() override { notifier_.clear(); }
  void finish_one() {
    const std::lock_guard lock(mutex_);
    ++allowed_;
    notifier_.notify();
  }

  pdu::TableModel tables;
  std::atomic<bool> away{false};
  std::atomic<bool> at_once{true};
  std::atomic<int> begun{0};

 private:
  std::mutex mutex_;
  std::deque<Written> begun_;
  int allowed_ = 0;
  host::Notifier notifier_;
};

class Client {
 public:
  explicit Client(std::uint16_t port, const char* from = "127.0.0.1")
      : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    inet_pton(AF_INET, from, &address.sin_addr);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    const int one = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &one, sizeof one);
  }
  ~Client() { close(); }
  Client(Client&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}
  Client& operator=(Client&&) = delete;

  void send(const Bytes& data) const {
    ASSERT_EQ(::send(socket_, data.data(), data.size(), MSG_NOSIGNAL), static_cast<ssize_t>(data.size()));
  }
  // As many bytes as arrive, up to `size`; "closed" at the end of the stream.
  std::string receive(std::size_t size, std::chrono::milliseconds patience = 60s) const {
    Bytes data(size);
    std::size_t got = 0;
    while (got < size) {
      pollfd entry{socket_, POLLIN, 0};
      if (poll(&entry, 1, static_cast<int>(patience.count())) <= 0) break;
      const ssize_t count = ::recv(socket_, data.data() + got, size - got, 0);
      if (count <= 0) return got == 0 ? "closed" : hex(std::span(data).first(got)) + " closed";
      got += static_cast<std::size_t>(count);
    }
    return hex(std::span(data).first(got));
  }
  std::string ask(const Bytes& request, std::size_t size) const {
    send(request);
    return receive(size);
  }
  void end_sending() const { shutdown(socket_, SHUT_WR); }
  void close() {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  }
  int descriptor() const { return socket_; }

 private:
  int socket_;
};

// A frame around a PDU.
inline Bytes frame(unsigned transaction, const Bytes& pdu, unsigned unit = 1) {
  Bytes out =
      bytes({transaction >> 8, transaction & 0xFF, 0, 0, 0, static_cast<unsigned>(pdu.size() + 1), unit});
  out.insert(out.end(), pdu.begin(), pdu.end());
  return out;
}

inline Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

inline ClientRule everything() {
  ClientRule rule;
  for (std::size_t table = 0; table < map::kTables; ++table)
    rule.read.push_back({static_cast<map::Table>(table)});
  rule.write = rule.read;
  return rule;
}

class ServerHarness {
 public:
  explicit ServerHarness(ServerOptions options = {}, TcpOptions tcp = {}) {
    if (options.clients.empty()) options.clients.push_back(everything());
    tcp.port = 0;
    if (tcp.allow.empty()) tcp.allow = {*network::IpRange::parse("127.0.0.0/8")};
    auto acceptor = std::move(*TcpAcceptor::open(tcp));
    port = acceptor->port();
    server = std::move(*Server::create(std::move(options), data));
    server->add(std::move(acceptor));
    thread_ = std::thread([this] {
      while (!quit_) server->run_for(5ms);
    });
  }
  ~ServerHarness() { stop(); }
  // Then its figures may be looked at.
  void stop() {
    quit_ = true;
    if (thread_.joinable()) thread_.join();
  }
  Client client(const char* from = "127.0.0.1") const { return Client(port, from); }

  TableData data;
  std::unique_ptr<Server> server;
  std::uint16_t port = 0;

 private:
  std::atomic<bool> quit_{false};
  std::thread thread_;
};

}  // namespace stepwright::modbus::server

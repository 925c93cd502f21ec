#pragma once

// A slave of libmodbus on a thread of its own, as a test wants it: what its registers hold, which units do
// not answer, how long it takes. An independent peer of our master and our oracle.
//
//   ModbusSlave slave;                                // TCP, a free port of the loopback
//   slave.set_register(3, 500);
//   master(TcpEndpoint{"127.0.0.1", slave.port()}) ...
//
// Threads: its own serves; every member may be called from any.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace stepwright::support {

struct ModbusSlaveOptions {
  std::uint16_t port = 0;   // 0: a free one
  std::string device = {};  // a serial line instead of TCP
  std::uint8_t unit = 1;    // on a line; over TCP it answers for all
  int registers = 1'000;    // of each table
};

class ModbusSlave {
 public:
  explicit ModbusSlave(const ModbusSlaveOptions& options = {});
  ~ModbusSlave();  // as if it were switched off: connections are reset
  ModbusSlave(const ModbusSlave&) = delete;
  ModbusSlave& operator=(const ModbusSlave&) = delete;

  std::uint16_t port() const { return port_; }
  int requests() const { return requests_; }
  int requests_of(std::uint8_t unit) const { return by_unit_[unit]; }
  int connections() const { return accepted_; }
  // PDUs in the order in which they came, function code first.
  std::vector<std::vector<std::uint8_t>> history() const;

  std::uint16_t holding(int address) const;
  bool coil(int address) const;
  void set_holding(int address, std::uint16_t value);
  void set_input(int address, std::uint16_t value);
  void set_coil(int address, bool value);
  void set_discrete(int address, bool value);

  void silence(std::uint8_t unit, bool silent) { silent_[unit] = silent; }
  void answer_after_ms(int time) { delay_ms_ = time; }
  // Answers every request with this exception; 0: as usual.
  void refuse_with(int exception) { exception_ = exception; }

 private:
  struct Peer;
  void serve_line();
  void serve_tcp();
  void answer(const std::uint8_t* query, int length);

  std::unique_ptr<Peer> peer_;
  std::uint16_t port_ = 0;
  bool serial_ = false;
  mutable std::mutex mutex_;  // of the mapping and the history
  std::vector<std::vector<std::uint8_t>> history_;
  std::atomic<bool> stop_{false};
  std::atomic<int> requests_{0};
  std::atomic<int> accepted_{0};
  std::atomic<int> delay_ms_{0};
  std::atomic<int> exception_{0};
  std::array<std::atomic<int>, 256> by_unit_{};
  std::array<std::atomic<bool>, 256> silent_{};
  std::thread thread_;
};

}  // namespace stepwright::support

#pragma once

// A Modbus master on one connection: a TCP address or a serial line, one or more units behind it. Owns a
// libmodbus context, whose header stays in master.cpp (ADR 0006).
//
//   auto master = Master::create(TcpEndpoint{"192.168.1.10", 502}, {.timeout = 300ms});
//   if (Outcome reached = master->connect(); !reached.good()) ...
//   master->select_unit(3);
//   std::array<std::uint16_t, 10> words;
//   if (master->read_registers(RegisterTable::Holding, 100, words).good()) ...
//
// Threads: one at a time. Every call is over within the timeout of the connection or of the answer; a name's
// look-up is not ours to bound. An answer is whole within the timeout of its request, however slowly it
// drips. On a line the time that request and answer take at its speed is added, and a call may take three
// timeouts where it meets the late answer of an earlier request.
// Invariants: counts, addresses and units outside the protocol never reach libmodbus; what arrived too late
// is thrown away before the next request, and on a line also the late answer of another unit while one is
// waited for. That of the same unit cannot be told from the answer to a request of the same form: leave a
// unit alone after a timeout. A line is this process's alone while it is connected. After ConnectionLost, and
// over TCP after BadAnswer, the connection is closed. A timeout leaves it open, because behind a gateway
// another unit may answer: whoever knows better calls close().

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>

#include "runtime/ground/result/result.h"
#include "runtime/modbus/master/endpoint.h"
#include "runtime/modbus/master/outcome.h"

namespace stepwright::modbus::master {

struct MasterOptions {
  std::chrono::milliseconds timeout{500};          // from a request to the end of its answer
  std::chrono::milliseconds connect_timeout{500};  // TCP
  // Silence before a request on a serial line; below zero: what frame_gap says. A pty needs none.
  std::chrono::microseconds gap{-1};
};

enum class BitTable : std::uint8_t { Coils, DiscreteInputs };
enum class RegisterTable : std::uint8_t { Holding, Input };

// Limits of one request (Modbus Application Protocol V1.1b3, section 6).
inline constexpr std::size_t kMaxReadBits = 2'000;
inline constexpr std::size_t kMaxWriteBits = 1'968;
inline constexpr std::size_t kMaxReadRegisters = 125;
inline constexpr std::size_t kMaxWriteRegisters = 123;
inline constexpr std::size_t kMaxWriteInReadWrite = 121;

class Master {
 public:
  // No connection yet. Fails with R0126 for a speed, parity or size that a line cannot have, and for a host
  // that is empty.
  [[nodiscard]] static result::Result<Master> create(const Endpoint& endpoint, const MasterOptions& options);
  ~Master();
  Master(Master&&) noexcept;
  Master& operator=(Master&&) noexcept;

  Outcome connect();  // anew, if it is connected
  void close();
  bool connected() const;
  // The path of the line leads to another device now: whoever hears nothing there had better connect anew.
  bool moved() const;

  // The slave of the following requests: 1 to 247 on a line, 0 to 247 or 255 over TCP. BadRequest otherwise.
  Outcome select_unit(std::uint8_t unit);
  void set_timeout(std::chrono::milliseconds timeout);

  // FC 1, 2; each byte becomes 0 or 1.
  Outcome read_bits(BitTable table, std::uint16_t first, std::span<std::uint8_t> bits);
  // FC 3, 4
  Outcome read_registers(RegisterTable table, std::uint16_t first, std::span<std::uint16_t> words);
  Outcome write_coil(std::uint16_t address, bool value);                                        // FC 5
  Outcome write_register(std::uint16_t address, std::uint16_t value);                           // FC 6
  Outcome write_coils(std::uint16_t first, std::span<const std::uint8_t> bits);                 // FC 15
  Outcome write_registers(std::uint16_t first, std::span<const std::uint16_t> words);           // FC 16
  Outcome mask_register(std::uint16_t address, std::uint16_t and_mask, std::uint16_t or_mask);  // FC 22
  // FC 23: the write comes before the read.
  Outcome read_write_registers(std::uint16_t write_first, std::span<const std::uint16_t> write,
                               std::uint16_t read_first, std::span<std::uint16_t> read);

 private:
  struct State;
  explicit Master(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::modbus::master

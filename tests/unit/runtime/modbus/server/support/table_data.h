#pragma once

// Values for a server in tests: tables in memory, whose writes are answered at once or when the test says so.
//
// Threads: one.

#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "runtime/modbus/pdu/wire.h"
#include "runtime/modbus/server/process_data.h"

namespace stepwright::modbus::server {

// 100 holding registers, which all other tables show too: input registers are the same, bits are bit 0 of
// them.
class TableData final : public ProcessData {
 public:
  TableData() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
  ~TableData() override { ::close(descriptor_); }

  pdu::Exception read(const pdu::Request& request, std::span<std::byte> table) override {
    if (request.address + request.count > registers.size()) return pdu::Exception::IllegalDataAddress;
    for (std::byte& each : table) each = std::byte{0};
    for (std::size_t i = 0; i < request.count; ++i) {
      const std::uint16_t value = registers[request.address + i];
      if (request.reads_bits())
        table[i / 8] |= std::byte(value & 1) << (i % 8);
      else
        pdu::put16(table, 2 * i, value);
    }
    return pdu::Exception::None;
  }

  // FC 6 and 16 only.
  pdu::Exception begin_write(std::uint64_t ticket, const pdu::Request& request) override {
    if (request.address + request.count > registers.size()) return pdu::Exception::IllegalDataAddress;
    for (std::size_t i = 0; i < request.count; ++i)
      registers[request.address + i] = pdu::get16(request.data, 2 * i);
    ++writes;
    done_.push_back({ticket, pdu::Exception::None});
    if (!held) tell();
    return pdu::Exception::None;
  }
  std::optional<Written> take_written() override {
    if (done_.empty() || held) return std::nullopt;
    const Written first = done_.front();
    done_.pop_front();
    return first;
  }
  int descriptor() const override { return descriptor_; }
  void clear() override {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto got = ::read(descriptor_, &count, sizeof count);
  }

  // The controller answers again.
  void release() {
    held = false;
    tell();
  }

  std::array<std::uint16_t, 100> registers{};
  int writes = 0;
  bool held = false;  // writes are not answered

 private:
  void tell() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto put = ::write(descriptor_, &one, sizeof one);
  }

  int descriptor_;
  std::deque<Written> done_;
};

}  // namespace stepwright::modbus::server

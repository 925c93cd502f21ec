#pragma once

// The UART of ARM's Cortex-M System Design Kit (DDI 0479, 4.3): 8 data bits, no parity, one stop bit, no
// FIFO; one interrupt a byte for either direction.

#include "firmware/boards/cmsdk/byte_queue.h"
#include "firmware/boards/cortex_m/registers.h"
#include "firmware/boards/cortex_m/sys_tick.h"
#include "firmware/port/uart.h"

namespace stepwright::boards {

class CmsdkUart final : public port::Uart, public Waiting {
 public:
  // `divider`: of the peripheral clock to the baud rate; 16 at least.
  CmsdkUart(std::uintptr_t base, std::uint32_t divider) : base_(base) {
    reg(base_ + kBaudDivider) = divider;
    reg(base_ + kControl) = 0b1111;  // both directions, both interrupts
  }

  // By the interrupts. The flag goes first: a byte that arrives between the two raises it again.
  void received() {
    reg(base_ + kInterrupt) = kReceive;
    while ((reg(base_ + kState) & kReceiveFull) != 0)
      static_cast<void>(incoming_.push(static_cast<std::byte>(reg(base_ + kData))));
  }
  void sent() {
    reg(base_ + kInterrupt) = kTransmit;
    feed();
  }

  bool waiting() const override { return !incoming_.empty(); }

  std::size_t read(std::span<std::byte> bytes) override {
    std::size_t count = 0;
    while (count < bytes.size() && incoming_.pop(bytes[count])) ++count;
    return count;
  }

  std::size_t write(std::span<const std::byte> bytes) override {
    std::size_t count = 0;
    while (count < bytes.size() && outgoing_.push(bytes[count])) ++count;
    const InterruptsOff off;
    feed();
    return count;
  }

 private:
  static constexpr std::uintptr_t kData = 0x00, kState = 0x04, kControl = 0x08, kInterrupt = 0x0C,
                                  kBaudDivider = 0x10;
  static constexpr std::uint32_t kTransmitFull = 1, kReceiveFull = 2;  // of kState
  static constexpr std::uint32_t kTransmit = 1, kReceive = 2;          // of kInterrupt

  // Gives the hardware what it takes.
  void feed() {
    std::byte byte;
    while ((reg(base_ + kState) & kTransmitFull) == 0 && outgoing_.pop(byte))
      reg(base_ + kData) = std::to_integer<std::uint32_t>(byte);
  }

  std::uintptr_t base_;
  ByteQueue incoming_;
  ByteQueue outgoing_;
};

}  // namespace stepwright::boards

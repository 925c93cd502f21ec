#pragma once

// A board of a test's own: time that it sets, a line in memory, flash whose power can be cut, and the
// firmware on it. Threads: one.

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/app/firmware.h"
#include "firmware/boards/emulated/ram_flash.h"

namespace stepwright::support {

class TestTick final : public port::Tick {
 public:
  std::int64_t now_ns() override { return now; }
  void rest() override { ++rests; }
  std::int64_t now = 0;
  int rests = 0;
};

class TestUart final : public port::Uart {
 public:
  std::size_t read(std::span<std::byte> bytes) override {
    std::size_t count = 0;
    for (; count < bytes.size() && !incoming.empty(); ++count) {
      bytes[count] = incoming.front();
      incoming.pop_front();
    }
    return count;
  }
  // A few bytes at a time, as a ring that is nearly full takes them.
  std::size_t write(std::span<const std::byte> bytes) override {
    const std::size_t count = std::min<std::size_t>(bytes.size(), 7);
    outgoing.insert(outgoing.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  std::deque<std::byte> incoming;
  std::vector<std::byte> outgoing;
};

// After `bytes_left` more bytes have been programmed or erased nothing changes any more: the power is gone,
// only the program has not noticed yet.
class TestFlash final : public port::Flash {
 public:
  explicit TestFlash(std::span<std::byte> memory) : flash_(memory) {}

  std::uint32_t page_bytes() const override { return flash_.page_bytes(); }
  std::span<const std::byte> content() const override { return flash_.content(); }

  bool erase(std::uint32_t offset) override {
    if (!spend(page_bytes())) return true;
    return flash_.erase(offset);
  }
  bool program(std::uint32_t offset, std::span<const std::byte> bytes) override {
    programmed += bytes.size();
    const std::size_t before = bytes_left;
    if (spend(bytes.size())) return flash_.program(offset, bytes);
    return flash_.program(offset, bytes.first(before));
  }
  std::size_t bytes_left = SIZE_MAX;
  std::size_t programmed = 0;

 private:
  bool spend(std::size_t bytes) {
    const bool enough = bytes <= bytes_left;
    bytes_left = enough ? bytes_left - bytes : 0;
    return enough;
  }
  boards::RamFlash flash_;
};

class TestWatchdog final : public port::Watchdog {
 public:
  void start(std::uint32_t) override { started = true; }
  void feed() override { ++fed; }
  std::uint16_t resets() const override { return count; }
  bool caused_this_start() const override { return caused; }
  bool started = false;
  int fed = 0;
  std::uint16_t count = 0;
  bool caused = false;
};

class TestBoard {
 public:
  explicit TestBoard(std::size_t memory_bytes = 1u << 20, std::size_t flash_bytes = 1u << 20)
      : flash_memory_(flash_bytes), flash(flash_memory_), memory_(memory_bytes / 8) {
    reset();
  }

  // The firmware starts again; the flash keeps what it has.
  void reset() {
    firmware_.reset();
    uart = {};
    flash.bytes_left = SIZE_MAX;
    firmware_.emplace(board_);
    firmware_->boot();
  }

  app::Firmware& firmware() { return *firmware_; }
  app::Controller& controller() { return firmware_->controller(); }
  app::Machine& machine() { return controller().machine(); }
  std::span<std::byte> flash_memory() { return flash_memory_; }

  // Time goes on in steps of a millisecond, with a round of the main loop in each.
  void run_ms(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      tick.now += 1'000'000;
      firmware_->turn();
    }
  }

 private:
  std::vector<std::byte> flash_memory_;

 public:
  TestTick tick;
  TestUart uart;
  TestFlash flash;
  TestWatchdog watchdog;

 private:
  std::vector<std::uint64_t> memory_;
  port::Board board_{"test board", tick, uart, flash, watchdog, std::as_writable_bytes(std::span(memory_))};
  std::optional<app::Firmware> firmware_;
};

}  // namespace stepwright::support

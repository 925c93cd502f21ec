#pragma once

// A line to a ControllerModel in the same process, through the slave's real engine, that can be cut, can lose
// answers and can say something else than the controller.
//
//   ModelLine* line = nullptr;                       // of the runtime that owns it
//   auto owned = std::make_unique<ModelLine>(state); state->cut = true;
//
// Threads: the line's; the faults may be set by any thread. The line lives with the runtime, so that what a
// test wants to look at or change stands in a state of its own.

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "runtime/modbus/pdu/serve.h"
#include "runtime/modbus/pdu/wire.h"
#include "runtime/remote/register_line.h"
#include "tests/support/modbus_controller/control_registers.h"

namespace stepwright::support {

struct ModelWorld {
  explicit ModelWorld(const ModelLimits& limits = {}) : model(limits), registers(model) {}
  std::mutex mutex;  // around model and registers
  ControllerModel model;
  ControlRegisters registers;
  std::atomic<bool> cut{false};
  std::atomic<bool> garble{false};
  std::atomic<int> lose_answers{0};   // so many requests are carried out and their answers lost
  std::atomic<int> lose_requests{0};  // so many never arrive
  // So many answers come only when the next request waits for its own, as on a serial line, on which nothing
  // but their form tells them from that.
  std::atomic<int> late_answers{0};
  std::atomic<std::uint64_t> requests{0};
  // Changes what the controller answers to a read (first register, words); may be empty. Set before use.
  std::function<void(std::uint16_t, std::span<std::uint16_t>)> lie;
};

class ModelLine final : public remote::RegisterLine {
 public:
  explicit ModelLine(std::shared_ptr<ModelWorld> world) : world_(std::move(world)) {}

  remote::LineAnswer read(std::uint16_t first, std::span<std::uint16_t> words) override {
    return transact(
        [&](std::span<std::byte> bytes) {
          return world_->registers.read_registers(modbus::pdu::RegisterTable::Holding, first,
                                                  static_cast<std::uint16_t>(words.size()), bytes);
        },
        first, words);
  }
  remote::LineAnswer write(std::uint16_t first, std::span<const std::uint16_t> words) override {
    const auto sent = wire(words);
    return transact(
        [&](std::span<std::byte>) {
          return world_->registers.write_registers(first, static_cast<std::uint16_t>(words.size()), sent);
        },
        first, {});
  }
  remote::LineAnswer read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                std::uint16_t read_first, std::span<std::uint16_t> read) override {
    const auto sent = wire(write);
    return transact(
        [&](std::span<std::byte> bytes) {
          return world_->registers.read_write_registers(
              {read_first, static_cast<std::uint16_t>(read.size()), write_first,
               static_cast<std::uint16_t>(write.size()), sent},
              bytes);
        },
        read_first, read);
  }
  remote::LineAnswer reopen() override {
    return world_->cut ? remote::LineAnswer{remote::LineFault::Closed, 0, "cut"} : remote::LineAnswer{};
  }
  std::string name() const override { return "model"; }

 private:
  static std::vector<std::byte> wire(std::span<const std::uint16_t> words) {
    std::vector<std::byte> bytes;
    for (const std::uint16_t word : words) {
      bytes.push_back(static_cast<std::byte>(word >> 8));
      bytes.push_back(static_cast<std::byte>(word & 0xFF));
    }
    return bytes;
  }
  static bool take(std::atomic<int>& count) {
    int left = count.load();
    while (left > 0 && !count.compare_exchange_weak(left, left - 1)) {
    }
    return left > 0;
  }

  template <typename Request>
  remote::LineAnswer transact(const Request& request, std::uint16_t first, std::span<std::uint16_t> words) {
    using remote::LineFault;
    ++world_->requests;
    if (world_->cut) return {LineFault::Closed, 0, "cut"};
    if (take(world_->lose_requests)) return {LineFault::Silent, 0, {}};
    std::vector<std::byte> bytes(2 * words.size());
    {
      const std::lock_guard lock(world_->mutex);
      const auto exception = request(std::span(bytes));
      if (exception != modbus::pdu::Exception::None)
        return {LineFault::Refused, static_cast<std::uint8_t>(exception), {}};
    }
    if (take(world_->lose_answers)) return {LineFault::Silent, 0, {}};
    if (take(world_->late_answers)) {
      late_.push_back(std::move(bytes));
      return {LineFault::Silent, 0, {}};
    }
    if (!late_.empty()) {
      late_.push_back(std::move(bytes));
      bytes = std::move(late_.front());
      late_.pop_front();
      if (bytes.size() != 2 * words.size()) {
        late_.clear();  // a master throws away what it has not asked for
        return {LineFault::Garbled, 0, "length"};
      }
    }
    if (world_->garble) return {LineFault::Garbled, 0, "checksum"};
    for (std::size_t i = 0; i < words.size(); ++i)
      words[i] = static_cast<std::uint16_t>(std::to_integer<unsigned>(bytes[2 * i]) << 8 |
                                            std::to_integer<unsigned>(bytes[2 * i + 1]));
    if (world_->lie) world_->lie(first, words);
    return {};
  }

  std::shared_ptr<ModelWorld> world_;
  std::deque<std::vector<std::byte>> late_;
};

}  // namespace stepwright::support

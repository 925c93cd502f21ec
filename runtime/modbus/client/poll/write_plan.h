#pragma once

// Plan of the writes to one slave: the values that are wanted, and those that it has acknowledged. Neighbours
// that are due go in one request; objects that no tag has are never written, but for the other bits of a
// register where the slave cannot mask.
//
//   WritePlan plan(device);
//   plan.set_outputs(area, now);
//   while (auto request = plan.next(now)) plan.done(*request, send(*request), now);
//
// Threads: one at a time. Instants are those of the steady clock.

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/modbus/client/settings.h"

namespace stepwright::modbus::client {

struct WriteRequest {
  Table table = Table::HoldingRegisters;
  std::uint16_t first = 0;
  std::vector<std::uint16_t> words;  // or bits, 0 and 1
  std::uint16_t mask = 0;            // not 0: FC 22, only these bits of the one register
  std::vector<std::uint32_t> cells;
};

class WritePlan {
 public:
  using Clock = std::chrono::steady_clock;

  explicit WritePlan(const Device& device);

  // The output area of the image, as it is to be from now on.
  void set_outputs(std::span<const std::byte> area);
  // Nothing counts as acknowledged: the slave may have been switched off meanwhile.
  void forget();

  // The next request; nothing before outputs were set, or if all is as it should be.
  std::optional<WriteRequest> next(Clock::time_point now) const;
  // How it ended; a refused one is tried again after Device::retry_after.
  void done(const WriteRequest& request, bool acknowledged, Clock::time_point now);

  // When next() has something again, if the outputs stay as they are; none: never.
  std::optional<Clock::time_point> due() const;
  // Everything that was set is acknowledged.
  bool clean() const;
  // The outputs in the order of the groups; of what a request writes.
  std::vector<std::uint32_t> tags_of(const WriteRequest& request) const;
  // 1: the slave's number could not hold the value.
  std::uint8_t exceeded(std::uint32_t tag) const { return exceeded_[tag]; }

 private:
  // A unit of writing: a number, a coil, or all bits of a register that tags have.
  struct Cell {
    Table table;
    std::uint16_t first;
    std::uint16_t count;
    std::uint16_t mask;                // not 0: bits of a register
    std::chrono::milliseconds period;  // 0: on change
    std::vector<std::uint32_t> tags;
    std::array<std::uint16_t, 4> wanted{};
    std::array<std::uint16_t, 4> acknowledged{};
    bool known = false;  // `acknowledged` is what the slave has
    Clock::time_point written{};
    Clock::time_point not_before{};  // after a refusal
  };

  void add(const Tag& tag, std::uint32_t index, const Group& group);
  Clock::time_point due(const Cell& cell) const;
  bool joins(const Cell& before, const Cell& cell) const;

  bool mask_writes_;
  std::chrono::milliseconds refresh_;
  std::chrono::milliseconds retry_after_;
  std::vector<Tag> tags_;
  std::vector<std::uint8_t> exceeded_;
  std::vector<Cell> cells_;  // by table and address
  bool set_ = false;
};

}  // namespace stepwright::modbus::client

#pragma once

// A line to a board in the same process that can be cut, can lose answers and can say something else than the
// board. The world around it outlives the line, so that a test can look at the board, whose line a runtime
// owns, and change what happens on it.
//
//   auto world = std::make_shared<BoardWorld>();
//   auto line = std::make_unique<FaultyLine>(world);  // for the runtime
//   world->cut = true;
//
// Threads: the line is its owner's; the faults may be set by any thread, the board looked at under the mutex.

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "runtime/remote/register_line.h"
#include "tests/support/board/board_line.h"
#include "tests/support/board/test_board.h"

namespace stepwright::support {

struct BoardWorld {
  explicit BoardWorld(std::size_t flash_bytes = 1u << 20) : board(1u << 20, flash_bytes) {}
  std::mutex mutex;  // around the board and its line
  TestBoard board;
  BoardLine line{board};
  std::atomic<bool> cut{false};
  std::atomic<bool> garble{false};
  std::atomic<int> lose_answers{0};   // so many requests are carried out and their answers lost
  std::atomic<int> lose_requests{0};  // so many never arrive
  // So many answers come only when the next request waits for its own, as on a serial line, on which nothing
  // but their form tells them from that.
  std::atomic<int> late_answers{0};
  std::atomic<std::uint64_t> requests{0};
  // Changes what the board answers to a read (first register, words); may be empty. Set before use.
  std::function<void(std::uint16_t, std::span<std::uint16_t>)> lie;
};

class FaultyLine final : public remote::RegisterLine {
 public:
  explicit FaultyLine(std::shared_ptr<BoardWorld> world) : world_(std::move(world)) {}

  remote::LineAnswer read(std::uint16_t first, std::span<std::uint16_t> words) override {
    return transact([&](std::span<std::uint16_t> into) { return world_->line.read(first, into); }, first,
                    words);
  }
  remote::LineAnswer write(std::uint16_t first, std::span<const std::uint16_t> words) override {
    return transact([&](std::span<std::uint16_t>) { return world_->line.write(first, words); }, first, {});
  }
  remote::LineAnswer read_write(std::uint16_t write_first, std::span<const std::uint16_t> write,
                                std::uint16_t read_first, std::span<std::uint16_t> read) override {
    return transact(
        [&](std::span<std::uint16_t> into) {
          return world_->line.read_write(write_first, write, read_first, into);
        },
        read_first, read);
  }
  remote::LineAnswer reopen() override {
    return world_->cut ? remote::LineAnswer{remote::LineFault::Closed, 0, "cut"} : remote::LineAnswer{};
  }
  std::string name() const override { return world_->line.name(); }

 private:
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
    std::vector<std::uint16_t> answer(words.size());
    {
      const std::lock_guard lock(world_->mutex);
      if (auto given = request(std::span(answer)); !given.ok()) return given;
    }
    if (take(world_->lose_answers)) return {LineFault::Silent, 0, {}};
    if (take(world_->late_answers)) {
      late_.push_back(std::move(answer));
      return {LineFault::Silent, 0, {}};
    }
    if (!late_.empty()) {
      late_.push_back(std::move(answer));
      answer = std::move(late_.front());
      late_.pop_front();
      if (answer.size() != words.size()) {
        late_.clear();  // a master throws away what it has not asked for
        return {LineFault::Garbled, 0, "length"};
      }
    }
    if (world_->garble) return {LineFault::Garbled, 0, "checksum"};
    std::copy(answer.begin(), answer.end(), words.begin());
    if (world_->lie) world_->lie(first, words);
    return {};
  }

  std::shared_ptr<BoardWorld> world_;
  std::deque<std::vector<std::uint16_t>> late_;
};

}  // namespace stepwright::support

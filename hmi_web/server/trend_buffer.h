#pragma once

// The newest minutes of the trend points, numbered row by row, so that a page opened late sees what was and a
// slow reader catches up without a gap. When time runs backwards (another run began) it starts anew.
//
// Thread rule: one thread at a time. Invariant: at most `capacity` rows, times strictly ascending.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "hmi_web/protocol/cell_state.h"

namespace stepwright::server {

class TrendBuffer {
 public:
  explicit TrendBuffer(std::size_t capacity) : capacity_(capacity) {}

  // A row that is not newer than the last is left out.
  void add(protocol::TrendRow row);

  // Counts the times that the buffer started anew; rows of different runs do not belong together.
  std::uint64_t run() const { return run_; }
  // Number of the oldest row that is kept.
  std::uint64_t begin() const { return first_; }
  // Number of the row behind the newest; rows of a run are numbered from 0.
  std::uint64_t end() const { return first_ + rows_.size(); }
  // Up to `most` rows from number `from` on, or from the oldest kept if that one is gone; the number of the
  // first one comes back in `from`.
  std::vector<protocol::TrendRow> rows(std::uint64_t& from, std::size_t most) const;

 private:
  std::size_t capacity_;
  std::uint64_t run_ = 0;
  std::uint64_t first_ = 0;
  std::deque<protocol::TrendRow> rows_;
};

}  // namespace stepwright::server

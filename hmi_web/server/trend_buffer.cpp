#include "hmi_web/server/trend_buffer.h"

#include <algorithm>
#include <utility>

namespace stepwright::server {

void TrendBuffer::add(protocol::TrendRow row) {
  if (!rows_.empty() && row.time_s == rows_.back().time_s) return;
  if (!rows_.empty() && row.time_s < rows_.back().time_s) {
    rows_.clear();
    first_ = 0;
    ++run_;
  }
  rows_.push_back(std::move(row));
  if (rows_.size() > capacity_) {
    rows_.pop_front();
    ++first_;
  }
}

std::vector<protocol::TrendRow> TrendBuffer::rows(std::uint64_t& from, std::size_t most) const {
  from = std::clamp(from, first_, end());
  const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(from - first_);
  const auto count = std::min<std::size_t>(most, static_cast<std::size_t>(end() - from));
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace stepwright::server

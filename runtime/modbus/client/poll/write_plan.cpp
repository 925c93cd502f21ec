#include "runtime/modbus/client/poll/write_plan.h"

#include <algorithm>
#include <tuple>

#include "runtime/modbus/client/poll/conversion.h"
#include "runtime/modbus/master/master.h"

namespace stepwright::modbus::client {

WritePlan::WritePlan(const Device& device)
    : mask_writes_(device.mask_writes), refresh_(device.refresh), retry_after_(device.retry_after) {
  for (const Group& group : device.groups) {
    for (const Tag& tag : group.outputs) {
      tags_.push_back(tag);
      add(tag, static_cast<std::uint32_t>(tags_.size() - 1), group);
    }
  }
  exceeded_.resize(tags_.size());
  std::ranges::sort(cells_, [](const Cell& a, const Cell& b) {
    return std::tuple(a.table, a.first) < std::tuple(b.table, b.first);
  });
}

void WritePlan::add(const Tag& tag, std::uint32_t index, const Group& group) {
  const auto period = group.write == WriteMode::Cyclic ? group.period : std::chrono::milliseconds(0);
  if (tag.bit == Tag::kWholeRegister) {
    cells_.push_back({tag.table, tag.first, tag.count(), 0, period, {index}, {}, {}, false, {}, {}});
    return;
  }
  const auto mask = static_cast<std::uint16_t>(1u << tag.bit);
  const auto same = std::ranges::find_if(cells_, [&](const Cell& cell) {
    return cell.mask != 0 && cell.table == tag.table && cell.first == tag.first;
  });
  if (same == cells_.end()) {
    cells_.push_back({tag.table, tag.first, 1, mask, period, {index}, {}, {}, false, {}, {}});
    return;
  }
  same->mask |= mask;
  same->tags.push_back(index);
  if (period.count() != 0 && (same->period.count() == 0 || period < same->period)) same->period = period;
}

void WritePlan::set_outputs(std::span<const std::byte> area) {
  set_ = true;
  for (Cell& cell : cells_) {
    std::array<std::uint16_t, 4> wanted{};
    for (const std::uint32_t index : cell.tags) {
      const Tag& tag = tags_[index];
      const WireValue wire = to_wire(tag, get_field(area, tag.field));
      exceeded_[index] = wire.exceeded ? 1 : 0;
      if (cell.mask == 0) {
        wanted = wire.words;
      } else if (wire.words[0] != 0) {
        wanted[0] |= static_cast<std::uint16_t>(1u << tag.bit);
      }
    }
    cell.wanted = wanted;
  }
}

void WritePlan::forget() {
  for (Cell& cell : cells_) {
    cell.known = false;
    cell.not_before = {};
  }
}

WritePlan::Clock::time_point WritePlan::due(const Cell& cell) const {
  if (!cell.known || cell.wanted != cell.acknowledged) return cell.not_before;
  if (cell.period.count() > 0) return cell.written + cell.period;
  return refresh_.count() > 0 ? cell.written + refresh_ : Clock::time_point::max();
}

bool WritePlan::joins(const Cell& before, const Cell& cell) const {
  const bool whole = !mask_writes_ || (before.mask == 0 && cell.mask == 0);
  return whole && before.table == cell.table && before.first + before.count == cell.first;
}

std::optional<WriteRequest> WritePlan::next(Clock::time_point now) const {
  if (!set_) return std::nullopt;
  // The one that waits for longest, so that none starves.
  const auto oldest = std::ranges::min_element(
      cells_, {}, [&](const Cell& cell) { return std::tuple(due(cell), cell.written); });
  if (oldest == cells_.end() || due(*oldest) > now) return std::nullopt;
  WriteRequest request{oldest->table, oldest->first, {}, mask_writes_ ? oldest->mask : std::uint16_t{0}, {}};
  const std::size_t most = is_bits(oldest->table) ? master::kMaxWriteBits : master::kMaxWriteRegisters;
  for (auto cell = oldest; cell != cells_.end(); ++cell) {
    const bool follows = cell == oldest || (joins(*(cell - 1), *cell) && due(*cell) <= now);
    if (!follows || request.words.size() + cell->count > most) break;
    request.words.insert(request.words.end(), cell->wanted.begin(), cell->wanted.begin() + cell->count);
    request.cells.push_back(static_cast<std::uint32_t>(cell - cells_.begin()));
  }
  return request;
}

void WritePlan::done(const WriteRequest& request, bool acknowledged, Clock::time_point now) {
  std::size_t at = 0;
  for (const std::uint32_t index : request.cells) {
    Cell& cell = cells_[index];
    if (acknowledged) {
      std::copy_n(request.words.begin() + static_cast<std::ptrdiff_t>(at), cell.count,
                  cell.acknowledged.begin());
      cell.known = true;
      cell.written = now;
      cell.not_before = {};
    } else {
      cell.known = false;
      cell.not_before = now + retry_after_;
    }
    at += cell.count;
  }
}

std::optional<WritePlan::Clock::time_point> WritePlan::due() const {
  if (!set_ || cells_.empty()) return std::nullopt;
  auto first = Clock::time_point::max();
  for (const Cell& cell : cells_) first = std::min(first, due(cell));
  return first == Clock::time_point::max() ? std::nullopt : std::optional(first);
}

bool WritePlan::clean() const {
  return !set_ || std::ranges::all_of(cells_, [](const Cell& cell) {
    return cell.known && cell.wanted == cell.acknowledged;
  });
}

std::vector<std::uint32_t> WritePlan::tags_of(const WriteRequest& request) const {
  std::vector<std::uint32_t> tags;
  for (const std::uint32_t index : request.cells)
    tags.insert(tags.end(), cells_[index].tags.begin(), cells_[index].tags.end());
  return tags;
}

}  // namespace stepwright::modbus::client

#include "supervisor/htn/search/agenda.h"

#include <algorithm>

#include "supervisor/htn/search/fingerprint.h"

namespace stepwright::htn {
namespace {

constexpr std::size_t kFirstCells = 256;

}  // namespace

// Where the cell is or would go.
std::size_t Agenda::place(int task, int rest) const {
  const std::size_t mask = places_.size() - 1;
  const auto key =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(task)) << 32 | static_cast<std::uint32_t>(rest);
  std::size_t at = scramble(key) & mask;
  for (; places_[at] != 0; at = (at + 1) & mask) {
    const Cell& cell = cells_[static_cast<std::size_t>(places_[at] - 1)];
    if (cell.task == task && cell.rest == rest) break;
  }
  return at;
}

void Agenda::grow() {
  places_.assign(std::max(kFirstCells, 2 * places_.size()), 0);
  for (std::size_t i = 0; i < cells_.size(); ++i)
    places_[place(cells_[i].task, cells_[i].rest)] = static_cast<int>(i) + 1;
}

int Agenda::push(int task, int rest) {
  if (2 * (cells_.size() + 1) > places_.size()) grow();
  int& number = places_[place(task, rest)];
  if (number == 0) {
    cells_.push_back({task, rest, length(rest) + 1});
    number = static_cast<int>(cells_.size());
  }
  return number - 1;
}

}  // namespace stepwright::htn

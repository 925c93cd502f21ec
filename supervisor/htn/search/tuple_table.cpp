#include "supervisor/htn/search/tuple_table.h"

#include <algorithm>

#include "supervisor/htn/search/fingerprint.h"

namespace stepwright::htn {
namespace {

constexpr std::size_t kFirstPlaces = 64;

std::uint64_t hash_of(int head, std::span<const int> objects) {
  std::uint64_t hash = scramble(static_cast<std::uint32_t>(head));
  for (const int object : objects) hash = (hash ^ static_cast<std::uint32_t>(object)) * 0xD6E8FEB86659FD93u;
  return hash ^ hash >> 32;
}

}  // namespace

// Where the tuple is or would go.
std::size_t TupleTable::place(int head, std::span<const int> tuple) const {
  const std::size_t mask = places_.size() - 1;
  std::size_t at = hash_of(head, tuple) & mask;
  for (; places_[at] != 0; at = (at + 1) & mask) {
    const int id = places_[at] - 1;
    if (this->head(id) == head && std::ranges::equal(objects(id), tuple)) break;
  }
  return at;
}

void TupleTable::grow() {
  places_.assign(std::max(kFirstPlaces, 2 * places_.size()), 0);
  for (int id = 0; id < static_cast<int>(entries_.size()); ++id)
    places_[place(head(id), objects(id))] = id + 1;
}

int TupleTable::find(int head, std::span<const int> tuple) const {
  return places_.empty() ? -1 : places_[place(head, tuple)] - 1;
}

int TupleTable::intern(int head, std::span<const int> tuple) {
  if (2 * (entries_.size() + 1) > places_.size()) grow();
  int& number = places_[place(head, tuple)];
  if (number == 0) {
    entries_.push_back({pool_.size(), tuple.size(), head});
    pool_.insert(pool_.end(), tuple.begin(), tuple.end());
    number = static_cast<int>(entries_.size());
  }
  return number - 1;
}

}  // namespace stepwright::htn

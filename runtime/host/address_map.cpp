#include "runtime/host/address_map.h"

#include <algorithm>
#include <tuple>

namespace stepwright::host {

using record::StateVariable;

AddressMap::AddressMap(const record::StateLayout& from, const record::StateLayout& to)
    : from_(from.areas()), to_(to.areas()) {
  for (const StateVariable& old : from.variables()) {
    const StateVariable* found = to.find(old.path);
    if (found == nullptr || found->is_array != old.is_array) continue;
    const record::StateType& type = from.type_of(old);
    if (!record::takes(to.type_of(*found), type) || to.type_of(*found).size != type.size) continue;
    const std::int64_t first = std::max(old.lower, found->lower);
    const std::int64_t end =
        std::min(std::int64_t{old.lower} + old.count, std::int64_t{found->lower} + found->count);
    if (first >= end) continue;
    entries_.push_back({.from = old.address + static_cast<std::uint32_t>(first - old.lower) * type.size,
                        .size = static_cast<std::uint32_t>(end - first) * type.size,
                        .to = found->address + static_cast<std::uint32_t>(first - found->lower) * type.size,
                        .from_bit = old.bit,
                        .to_bit = found->bit});
  }
  const auto order = [](const Entry& a, const Entry& b) {
    return std::tie(a.from, a.from_bit) < std::tie(b.from, b.from_bit);
  };
  std::stable_sort(entries_.begin(), entries_.end(), order);
}

std::optional<ImagePlace> AddressMap::find(std::uint32_t address, std::uint32_t size,
                                           std::uint8_t bit) const {
  auto entry = std::upper_bound(entries_.begin(), entries_.end(), address,
                                [](std::uint32_t at, const Entry& each) { return at < each.from; });
  while (entry != entries_.begin()) {
    --entry;
    if (address - entry->from >= entry->size) break;
    const bool whole = entry->from_bit == bytecode::kNoBit;
    if (!whole && entry->from_bit != bit) continue;  // another bit of the byte
    const std::uint32_t offset = address - entry->from;
    if (size > entry->size - offset) break;
    return ImagePlace{entry->to + offset, whole ? bit : entry->to_bit};
  }
  return terminal(address, size, bit);
}

std::optional<ImagePlace> AddressMap::terminal(std::uint32_t address, std::uint32_t size,
                                               std::uint8_t bit) const {
  if (address < from_.inputs) {
    if (address + size > std::min(from_.inputs, to_.inputs)) return std::nullopt;
    return ImagePlace{address, bit};
  }
  const std::uint32_t output = address - from_.inputs;
  if (output + size > std::min(from_.outputs, to_.outputs)) return std::nullopt;
  return ImagePlace{to_.inputs + output, bit};
}

}  // namespace stepwright::host

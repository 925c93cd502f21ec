#include "cell/import/address_plan.h"

#include <algorithm>
#include <tuple>

#include "ladder/syntax/direct_address.h"

namespace stepwright::cell_import {
namespace {

using naming::Area;

char letter_of(std::uint8_t bits) {
  return bits == 1 ? 'X' : bits == 8 ? 'B' : bits == 16 ? 'W' : bits == 32 ? 'D' : 'L';
}

std::string text_of(Area area, std::uint8_t bits, std::uint32_t bit) {
  std::string text = std::string("%") + "IQM"[static_cast<std::size_t>(area)] + letter_of(bits);
  if (bits == 1) return text + std::to_string(bit / 8) + "." + std::to_string(bit % 8);
  return text + std::to_string(bit / bits);
}

std::uint32_t first_bit(const naming::DirectAddress& address) {
  return address.byte * 8 + address.bit;
}

}  // namespace

std::optional<AddressPlan::Place> AddressPlan::place_of(const std::string& text) {
  if (const auto flat = naming::parse_direct_address(text)) {
    const std::uint32_t begin = first_bit(*flat);
    return Place{text, flat->area, flat->bits, {begin}, begin, begin + flat->bits};
  }
  if (const auto levels = syntax::parse_hierarchical(text)) {
    const auto area = static_cast<Area>(levels->address.area);
    const std::uint8_t bits = levels->address.bits;
    const std::uint64_t begin = std::uint64_t{levels->levels.back()} * bits;
    return Place{text, area, bits, levels->levels, begin, begin + bits};
  }
  return std::nullopt;
}

AddressPlan::AddressPlan(const std::vector<std::string>& addresses,
                         const std::map<std::string, std::uint32_t>& lengths) {
  std::vector<Place> places[3];
  std::set<std::string> seen;
  for (const std::string& text : addresses) {
    if (!seen.insert(text).second) continue;
    auto place = place_of(text);
    if (!place) {
      unknown_.push_back(text);
      continue;
    }
    const auto length = lengths.find(text);
    if (length != lengths.end()) place->end = std::max(place->end, place->begin + length->second);
    places[static_cast<std::size_t>(place->area)].push_back(std::move(*place));
  }
  for (const Area area : {Area::Input, Area::Output, Area::Marker})
    plan_area(area, std::move(places[static_cast<std::size_t>(area)]));
}

bool AddressPlan::stand_apart(const std::vector<Place>& places) {
  const auto shares = [](const Place& one, const Place& other) {
    return one.bits != other.bits && one.begin < other.end && other.begin < one.end;
  };
  const auto flat = [](const Place& place) { return place.levels.size() == 1; };
  return std::ranges::all_of(places, flat) && std::ranges::none_of(places, [&](const Place& one) {
           return std::ranges::any_of(places, [&](const Place& other) { return shares(one, other); });
         });
}

std::vector<AddressPlan::Group> AddressPlan::groups_of(std::vector<Place>& places) {
  std::ranges::sort(places, [](const Place& one, const Place& other) {
    return std::tie(one.bits, one.levels) < std::tie(other.bits, other.levels);
  });
  std::vector<Group> groups;
  std::map<std::pair<std::uint8_t, std::vector<std::uint32_t>>, std::size_t> last;  // group of each table
  for (const Place& place : places) {
    const std::vector<std::uint32_t> table(place.levels.begin(), place.levels.end() - 1);
    const auto [at, is_new] = last.try_emplace({place.bits, table}, groups.size());
    if (is_new || place.begin >= groups[at->second].end) {
      at->second = groups.size();
      groups.emplace_back();
    }
    Group& group = groups[at->second];
    group.places.push_back(&place);
    group.end = std::max(group.end, place.end);
  }
  return groups;
}

void AddressPlan::plan_area(Area area, std::vector<Place> places) {
  std::uint64_t next = 0;  // the first bit that is free
  if (stand_apart(places)) {
    for (const Place& place : places) {
      now_[place.text] = place.text;
      next = std::max(next, place.end);
    }
    bytes_[static_cast<std::size_t>(area)] = static_cast<std::uint32_t>((next + 7) / 8);
    return;
  }
  // A size behind the other; the order within a size is that of the addresses.
  for (const Group& group : groups_of(places)) {
    const Place& first = *group.places.front();
    const std::uint64_t start = (next + first.bits - 1) / first.bits * first.bits;
    for (const Place* place : group.places)
      now_[place->text] =
          text_of(area, place->bits, static_cast<std::uint32_t>(start + (place->begin - first.begin)));
    next = start + (group.end - first.begin);
  }
  bytes_[static_cast<std::size_t>(area)] = static_cast<std::uint32_t>((next + 7) / 8);
}

std::string AddressPlan::address(const std::string& before) const {
  const auto found = now_.find(before);
  return found == now_.end() ? before : found->second;
}

std::uint32_t AddressPlan::bytes(Area area) const {
  return bytes_[static_cast<std::size_t>(area)];
}

std::vector<std::pair<std::string, std::string>> AddressPlan::moved() const {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const auto& [before, now] : now_)
    if (before != now) pairs.emplace_back(before, now);
  std::ranges::sort(pairs, [](const auto& one, const auto& other) {
    const auto key = [](const std::string& text) {
      const auto address = naming::parse_direct_address(text);
      return std::make_tuple(address->area, address->byte, address->bit);
    };
    return key(one.second) < key(other.second);
  });
  return pairs;
}

}  // namespace stepwright::cell_import

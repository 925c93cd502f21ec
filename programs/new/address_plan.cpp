#include "programs/new/address_plan.h"

#include <algorithm>
#include <tuple>

#include "ladder/syntax/direct_address.h"

namespace stepwright::new_cell {
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
  if (const auto flat = naming::parse_direct_address(text))
    return Place{text, flat->area, flat->bits, {first_bit(*flat)}};
  if (const auto levels = syntax::parse_hierarchical(text)) {
    const auto area = static_cast<Area>(levels->address.area);
    return Place{text, area, levels->address.bits, levels->levels};
  }
  return std::nullopt;
}

AddressPlan::AddressPlan(const std::vector<std::string>& addresses) {
  std::vector<Place> places[3];
  std::set<std::string> seen;
  for (const std::string& text : addresses) {
    if (!seen.insert(text).second) continue;
    if (auto place = place_of(text))
      places[static_cast<std::size_t>(place->area)].push_back(std::move(*place));
    else
      unknown_.push_back(text);
  }
  for (const Area area : {Area::Input, Area::Output, Area::Marker})
    plan_area(area, std::move(places[static_cast<std::size_t>(area)]));
}

void AddressPlan::stay(const Place& place) {
  const auto flat = naming::parse_direct_address(place.text);
  now_[place.text] = place.text;
  std::uint32_t& bytes = bytes_[static_cast<std::size_t>(place.area)];
  bytes = std::max(bytes, flat->byte + std::max<std::uint32_t>(1, flat->bits / 8));
}

void AddressPlan::plan_area(Area area, std::vector<Place> places) {
  const auto flat = [](const Place& place) { return place.levels.size() == 1; };
  const auto shares = [](const Place& one, const Place& other) {
    return one.bits != other.bits && one.levels[0] < other.levels[0] + other.bits &&
           other.levels[0] < one.levels[0] + one.bits;
  };
  const bool all_flat = std::ranges::all_of(places, flat);
  const bool apart =
      all_flat && std::ranges::none_of(places, [&](const Place& one) {
        return std::ranges::any_of(places, [&](const Place& other) { return shares(one, other); });
      });
  if (apart) {
    for (const Place& place : places) stay(place);
    return;
  }
  // A size behind the other; the order within a size is that of the addresses.
  std::ranges::sort(places, [](const Place& one, const Place& other) {
    return std::tie(one.bits, one.levels) < std::tie(other.bits, other.levels);
  });
  std::uint32_t next = 0;
  const Place* before = nullptr;
  std::string text;
  for (const Place& place : places) {
    const bool same = before != nullptr && before->bits == place.bits && before->levels == place.levels;
    if (!same) {
      next = (next + place.bits - 1) / place.bits * place.bits;
      text = text_of(area, place.bits, next);
      next += place.bits;
    }
    now_[place.text] = text;
    before = &place;
  }
  bytes_[static_cast<std::size_t>(area)] = (next + 7) / 8;
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

}  // namespace stepwright::new_cell

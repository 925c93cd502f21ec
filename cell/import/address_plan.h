#pragma once

// Addresses of a project of another system in the image of a cell. There the sizes of an area are often
// tables of their own (OpenPLC: %IX0.0 and %IW0 are two things), or addresses have levels (Beremiz:
// %QX1.0.3). Here an area is bytes, %IW0 has the bits of %IX0.0 to %IX1.7, and an address for devices has no
// levels.
//
// An area stays as it is if all its addresses are flat and nothing of another size shares their bits; else
// its addresses of the smaller sizes come first, each size behind the one before. What is one place stays one
// place: equal addresses, and those within an array. Pure; not thread-safe.
//
//   AddressPlan plan({"%IX0.0", "%IW0"}, {{"%IW0", 160}});   // an array of ten words
//   plan.address("%IW0");      // "%IW1"
//   plan.bytes(Area::Input);   // 22

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/naming/direct_address.h"

namespace stepwright::cell_import {

class AddressPlan {
 public:
  // `lengths`: bits of what is at an address, where that is more than the address says.
  explicit AddressPlan(const std::vector<std::string>& addresses,
                       const std::map<std::string, std::uint32_t>& lengths = {});

  // Where it is now, as text; the same text if it stays, or is no address.
  std::string address(const std::string& before) const;
  // Bytes that the addresses of the area need.
  std::uint32_t bytes(naming::Area area) const;
  // Pairs of before and now, of all that have moved, in the order of the new ones.
  std::vector<std::pair<std::string, std::string>> moved() const;
  // What is no address, or has no place: it stays as it is.
  const std::vector<std::string>& unknown() const { return unknown_; }

 private:
  // Of any system: an area, a size, levels, and the bits [begin, end) of the table that all levels but the
  // last name; a flat address has one level, its first bit.
  struct Place {
    std::string text;
    naming::Area area = naming::Area::Input;
    std::uint8_t bits = 1;
    std::vector<std::uint32_t> levels;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };
  // What shares bits, in the order of their places: it stays together.
  struct Group {
    std::vector<const Place*> places;
    std::uint64_t end = 0;
  };

  static std::optional<Place> place_of(const std::string& text);
  static bool stand_apart(const std::vector<Place>& places);
  static std::vector<Group> groups_of(std::vector<Place>& places);
  void plan_area(naming::Area area, std::vector<Place> places);

  std::map<std::string, std::string> now_;
  std::uint32_t bytes_[3] = {0, 0, 0};
  std::vector<std::string> unknown_;
};

}  // namespace stepwright::cell_import

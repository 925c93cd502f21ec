#pragma once

// Map of the variables of one program to their places in another: by path, without regard to case, as far as
// the type of the other takes their values. What moves with its variable when programs change (forces,
// references) finds its new place here.
//
// Threads: made on any, immutable; `find` is for the scan thread too: no heap, no lock, O(log variables).
//
//   const AddressMap map(old_layout, new_layout);
//   if (auto place = map.find(address, 4, bytecode::kNoBit)) ...  // the same DINT in the other image

#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/record/state_layout.h"

namespace stepwright::host {

struct ImagePlace {
  std::uint32_t address = 0;
  std::uint8_t bit = bytecode::kNoBit;

  friend bool operator==(const ImagePlace&, const ImagePlace&) = default;
};

class AddressMap {
 public:
  AddressMap() = default;  // finds nothing
  AddressMap(const record::StateLayout& from, const record::StateLayout& to);

  // The new place of `size` bytes of one variable, or of its bit. A place in the inputs or outputs that no
  // variable of both programs holds is a terminal and keeps its number.
  std::optional<ImagePlace> find(std::uint32_t address, std::uint32_t size, std::uint8_t bit) const;

 private:
  struct Entry {
    std::uint32_t from = 0;
    std::uint32_t size = 0;
    std::uint32_t to = 0;
    std::uint8_t from_bit = bytecode::kNoBit;
    std::uint8_t to_bit = bytecode::kNoBit;
  };
  std::optional<ImagePlace> terminal(std::uint32_t address, std::uint32_t size, std::uint8_t bit) const;

  std::vector<Entry> entries_;  // by address, then bit
  record::StateAreas from_;
  record::StateAreas to_;
};

}  // namespace stepwright::host

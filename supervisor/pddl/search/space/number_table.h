#pragma once

// Numbers, each once, by index: an open-addressing table over their bits.
//
// Thread rule: one owner.

#include <vector>

#include "supervisor/pddl/search/space/packed_bits.h"

namespace stepwright::pddl {

class NumberTable {
 public:
  NumberTable() : slots_(64, kFree) {}

  // Takes the number in if it is new.
  std::uint32_t index_of(Word bits);
  Word operator[](std::size_t index) const { return numbers_[index]; }

  // Bytes held.
  std::size_t memory() const {
    return numbers_.capacity() * sizeof(Word) + slots_.capacity() * sizeof(std::uint32_t);
  }

 private:
  static constexpr std::uint32_t kFree = UINT32_MAX;
  std::size_t slot_of(Word bits) const;
  void grow();

  std::vector<Word> numbers_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace stepwright::pddl

#pragma once

// Some words for every node of a search, in blocks, so that nothing is copied when they grow.
//
// Thread rule: one owner. Pointers stay valid.

#include <memory>
#include <vector>

#include "supervisor/pddl/search/space/packed_bits.h"

namespace stepwright::pddl {

class NodeWords {
 public:
  explicit NodeWords(std::size_t words) : words_(words) {}

  // The node's words, zero at first.
  Word* operator[](std::uint32_t node) {
    while (node / kBlock >= blocks_.size()) blocks_.push_back(std::make_unique<Word[]>(kBlock * words_));
    return blocks_[node / kBlock].get() + node % kBlock * words_;
  }

  // Bytes held.
  std::size_t memory() const { return blocks_.size() * kBlock * words_ * sizeof(Word); }

 private:
  static constexpr std::uint32_t kBlock = 1024;
  std::size_t words_;
  std::vector<std::unique_ptr<Word[]>> blocks_;
};

}  // namespace stepwright::pddl

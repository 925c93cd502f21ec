#pragma once

// The states that a search has met, each once: nothing that a textbook would not have.
//
// Thread rule: one search, one store. Pointers to states are valid until the next `insert`.

#include <cstdint>
#include <cstring>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::bench {

class StateStore {
 public:
  explicit StateStore(std::size_t words) : words_(words), index_(1024, Hash{this}, Equal{this}) {}
  StateStore(const StateStore&) = delete;
  StateStore& operator=(const StateStore&) = delete;

  const pddl::Word* operator[](std::uint32_t state) const { return all_.data() + state * words_; }
  std::size_t size() const { return count_; }

  // The number of the state and whether it is new.
  std::pair<std::uint32_t, bool> insert(const pddl::Word* state) {
    all_.insert(all_.end(), state, state + words_);
    const auto [place, added] = index_.insert(count_);
    if (added) {
      ++count_;
    } else {
      all_.resize(all_.size() - words_);
    }
    return {*place, added};
  }

  // Bytes, about: a node of the index takes some 40.
  std::size_t memory() const { return all_.capacity() * sizeof(pddl::Word) + index_.size() * 40; }

 private:
  std::string_view bytes(std::uint32_t state) const {
    return {reinterpret_cast<const char*>((*this)[state]), words_ * sizeof(pddl::Word)};
  }
  struct Hash {
    const StateStore* store;
    std::size_t operator()(std::uint32_t state) const {
      return std::hash<std::string_view>()(store->bytes(state));
    }
  };
  struct Equal {
    const StateStore* store;
    bool operator()(std::uint32_t a, std::uint32_t b) const { return store->bytes(a) == store->bytes(b); }
  };

  std::size_t words_;
  std::uint32_t count_ = 0;
  std::vector<pddl::Word> all_;
  std::unordered_set<std::uint32_t, Hash, Equal> index_;
};

}  // namespace stepwright::bench

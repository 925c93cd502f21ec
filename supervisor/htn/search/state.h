#pragma once

// The symbolic state of the search: which facts hold, changed in place and taken back.
//
// Thread rule: one search, one state. Invariant: after `undo(mark())` it is as it was; numbers of facts stay.
//
//   const std::size_t before = state.mark();
//   state.set(fact, true);
//   state.undo(before);

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "supervisor/htn/search/fingerprint.h"
#include "supervisor/htn/search/tuple_table.h"
#include "supervisor/htn/task/planning_task.h"

namespace stepwright::htn {

class State {
 public:
  // The initial one.
  explicit State(const PlanningTask& task);

  // The number of an atom, given now if it has none.
  int fact(int predicate, std::span<const int> objects);
  bool holds(int predicate, std::span<const int> objects) const;
  bool holds(int fact) const { return place_[static_cast<std::size_t>(fact)] >= 0; }
  int predicate(int fact) const { return facts_.head(fact); }
  std::span<const int> objects(int fact) const { return facts_.objects(fact); }

  void set(int fact, bool value);
  std::size_t mark() const { return trail_.size(); }
  void undo(std::size_t mark);

  // Of the facts that hold.
  const Fingerprint& fingerprint() const { return fingerprint_; }

  // Facts of the predicate among which are all that hold and have `key` in the columns of the mask: the
  // caller looks at each. Valid until the next call of `fact` or `set`.
  const std::vector<int>& candidates(int predicate, std::uint64_t columns, std::span<const int> key);

 private:
  struct Index {
    int predicate = 0;
    std::uint64_t columns = 0;
    std::unordered_map<std::uint64_t, std::vector<int>> lists;  // by a hash of the key
  };

  void flip(int fact);
  void add(Index& index, int fact);

  TupleTable facts_;
  std::vector<int> place_;              // of each fact in the list of its predicate; -1: false
  std::vector<std::vector<int>> true_;  // of each predicate
  std::vector<int> trail_;              // flipped facts
  Fingerprint fingerprint_;
  std::vector<Index> indexes_;
  std::vector<std::vector<std::size_t>> indexes_of_;  // of each predicate
};

}  // namespace stepwright::htn

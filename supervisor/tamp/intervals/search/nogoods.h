#pragma once

// Store of nogoods: of each refutation the part of an object's handling that its conflict is made of, so that
// a task planner need not propose it again with other things around it. A nogood is proved: whatever matches
// one has no solution.
//
// Thread rule: one owner. The cell outlives the store and does not change: a nogood speaks of its numbers.
//
//   NogoodStore nogoods(cell);
//   nogoods.learn(sequence);                        // which the intervals have refuted
//   if (nogoods.refutes(another)) continue;         // no propagation is needed

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "supervisor/tamp/intervals/sequence/work_cell.h"

namespace stepwright::tamp {

class NogoodStore {
 public:
  explicit NogoodStore(const WorkCell& cell) : cell_(&cell) {}

  // False if the sequence is not provably infeasible. Requires what validate() accepts.
  bool learn(std::span<const Action> sequence, std::size_t most_nodes = 5'000);
  bool refutes(std::span<const Action> sequence) const;
  std::size_t size() const { return nogoods_.size(); }
  // "cup1 from its start: right picks cup1, right places cup1 on tray1".
  std::string text(std::size_t k) const;

 private:
  // Either these actions in a row among those of one object, or a whole beginning of the sequence.
  struct Nogood {
    std::optional<std::size_t> object;
    bool from_start = false;
    std::vector<Action> actions;
  };
  static bool matches(const Nogood& nogood, std::span<const Action> sequence);

  const WorkCell* cell_;
  std::vector<Nogood> nogoods_;
};

}  // namespace stepwright::tamp

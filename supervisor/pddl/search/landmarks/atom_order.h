#pragma once

// For every atom of a relaxed task: which atoms come before it on every relaxed plan from the initial state.
// The greatest solution of: what comes before an atom comes before all units that reach it, and what comes
// before a unit comes before one of its needs.
//
// Thread rule: one owner.

#include <deque>
#include <functional>
#include <vector>

#include "supervisor/pddl/search/relaxation/relaxed_task.h"

namespace stepwright::pddl {

class AtomOrder {
 public:
  explicit AtomOrder(const RelaxedTask& task);

  // False if `stop` said so; then nothing is known.
  bool work_out(const std::function<bool()>& stop);
  // Memory for a task: as many sets as there are atoms, of as many bits.
  static std::size_t bytes_for(const RelaxedTask& task) {
    return task.atoms() * ((task.atoms() + 63) / 64) * sizeof(Word);
  }

  // Can the atom be reached, the unit be applied?
  bool reached(std::size_t atom) const { return known_[atom]; }
  bool applied(std::size_t unit) const { return lacking_[unit] == 0; }
  // Sets of atoms as bits: before the atom, itself included; before the unit.
  std::size_t words() const { return words_; }
  const Word* before_atom(std::size_t atom) const { return sets_.data() + atom * words_; }
  void before_unit(std::size_t unit, std::vector<Word>& set) const;

 private:
  void wait(int unit);
  void meet(std::size_t atom, const Word* before);

  const RelaxedTask& task_;
  std::size_t words_;
  std::vector<bool> known_, waiting_;
  std::vector<Word> sets_;
  std::vector<int> lacking_;
  std::deque<int> queue_;
};

}  // namespace stepwright::pddl

#pragma once

// Learned clauses, each with two watched literals (Moskewicz et al. 2001): of each, one literal must be true.
// One thread.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "supervisor/fleet/schedule/internal/search_model.h"

namespace stepwright::fleet::internal {

using ClauseId = std::uint32_t;

class Clauses {
 public:
  explicit Clauses(std::size_t sections) : watches_(2 * sections) {}

  std::size_t size() const { return clauses_.size(); }
  std::span<const Literal> operator[](ClauseId id) const { return clauses_[id].literals; }

  // At least two literals; the first is the one that the clause makes true now, the second is of the latest
  // decision among the others. `levels`: of how many decisions its literals are.
  ClauseId add(std::vector<Literal> literals, std::uint32_t levels);

  // Finds what becomes unit or false because `now_false` is false. `value(l)`: 1 true, -1 false, 0 open.
  // `imply(l, clause)` is called for each unit. Answers a false clause, or kNone.
  template <typename Value, typename Imply>
  ClauseId visit(Literal now_false, Value&& value, Imply&& imply);

  // Drops the half of the longer clauses with the most levels. Only while nothing has a clause as its reason.
  void reduce();

  static constexpr ClauseId kNone = 0xFFFFFFFF;

 private:
  struct Clause {
    std::vector<Literal> literals;
    std::uint32_t levels;
  };
  struct Watch {
    ClauseId clause;
    Literal blocker;  // if true, the clause needs no look
  };

  void watch(ClauseId id);

  std::vector<Clause> clauses_;
  std::vector<std::vector<Watch>> watches_;  // by the literal that became false
};

template <typename Value, typename Imply>
ClauseId Clauses::visit(Literal now_false, Value&& value, Imply&& imply) {
  std::vector<Watch>& watches = watches_[now_false.value];
  std::size_t kept = 0;
  for (std::size_t k = 0; k < watches.size(); ++k) {
    const Watch watch = watches[k];
    if (value(watch.blocker) > 0) {
      watches[kept++] = watch;
      continue;
    }
    std::vector<Literal>& literals = clauses_[watch.clause].literals;
    if (literals[0] == now_false) std::swap(literals[0], literals[1]);
    std::size_t other = 2;
    while (other < literals.size() && value(literals[other]) < 0) ++other;
    if (value(literals[0]) <= 0 && other < literals.size()) {
      std::swap(literals[1], literals[other]);
      watches_[literals[1].value].push_back({watch.clause, literals[0]});
      continue;
    }
    watches[kept++] = {watch.clause, literals[0]};
    if (value(literals[0]) > 0) continue;
    if (value(literals[0]) < 0) {
      while (++k < watches.size()) watches[kept++] = watches[k];
      watches.resize(kept);
      return watch.clause;
    }
    imply(literals[0], watch.clause);
  }
  watches.resize(kept);
  return kNone;
}

}  // namespace stepwright::fleet::internal

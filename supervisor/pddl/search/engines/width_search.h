#pragma once

// Best-first search by width: states that show something new come first, those with fewer landmarks left
// before the others. New is a value, or a pair of values, that no state before had among those with as many
// landmarks left and as much done of the relaxed plan made when the last landmark was reached (Lipovetzky,
// Geffner 2017, "Best-first width search: exploration and exploitation in classical planning"). Which pairs
// were seen is kept in a filter of fixed size (Singh, Lipovetzky, Ramirez, Segovia-Aguas 2021, "Approximate
// novelty search"). Two facts on their own that hold from the start are never a new pair: where most facts
// are such (the free cells of a board), their pairs would take nearly all of the time. A state takes far less
// time than with an estimate, and what misleads estimates does not mislead it.
//
// Complete: its end without a plan proves that there is none.
//
// Thread rule: one call, one object. `run` can be resumed after Running.

#include <optional>
#include <vector>

#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/landmarks/landmark_count.h"
#include "supervisor/pddl/search/pruning/exchange_pruning.h"
#include "supervisor/pddl/search/relaxation/additive_heuristic.h"
#include "supervisor/pddl/search/space/node_words.h"
#include "supervisor/pddl/search/space/state_table.h"

namespace stepwright::pddl {

class WidthSearch {
 public:
  // The landmarks must outlive it. `objects`: of states that differ by exchanges one is enough; null: all
  // are met.
  WidthSearch(const RelaxedTask& task, SearchControl& control, const Landmarks& landmarks,
              const Interchangeable* objects = nullptr);

  // Works through about so many states, of which one expanded and eight met that are new count one: an
  // estimate would take as long. Found: a plan was offered to the control and was better. Exhausted: there is
  // none. Stopped: see `reason`.
  SearchStatus run(std::uint64_t states, StopReason& reason);

  // Values and pairs of values that were looked up so far.
  std::uint64_t looked_up() const { return looked_up_; }

 private:
  struct Entry {
    int novelty;  // size of the least set of values that is new
    int left;     // landmarks
    std::uint32_t order;
    std::uint32_t node;
    bool operator>(const Entry& other) const {
      if (novelty != other.novelty) return novelty > other.novelty;
      return left != other.left ? left > other.left : order > other.order;
    }
  };
  // Facts that a relaxed plan makes true.
  struct Steps {
    std::vector<int> facts;
  };
  // Data of a node beside the landmarks: how many are left, which relaxed plan it follows, how many of its
  // steps are done, and which, by bit.
  static constexpr std::size_t kLeft = 0, kSteps = 1, kDone = 2, kBits = 3, kStepWords = 2;

  bool meet(std::uint32_t node, std::uint32_t parent);
  bool plan_steps(Word* own);
  void mark_done(Word* own) const;
  int novelty(const Word* own, const Word* parent);
  void list_values(const Word* state, std::vector<std::uint64_t>& values) const;
  bool see(std::uint64_t key);
  void list_partners(const Word* own);
  void expand(std::uint32_t node);
  std::size_t bytes() const;

  const RelaxedTask& task_;
  const StateSpace& space_;
  SearchControl& control_;
  MemoryShare memory_;
  LandmarkCount count_;
  AdditiveHeuristic additive_;
  std::optional<ExchangePruning> exchanges_;
  StateTable nodes_;
  NodeWords reached_, own_;
  std::vector<Steps> steps_;
  std::vector<Entry> open_;
  std::vector<Word> seen_;  // a filter of bits
  std::vector<Word> before_, state_;
  std::vector<std::uint64_t> values_, values_before_;
  std::vector<std::uint64_t> usual_;            // by variable: the initial value, if it is a fact on its own
  std::vector<std::uint64_t> keys_;             // of values_, with the group of the state
  std::vector<std::size_t> present_, unusual_;  // of values_
  std::vector<int> applicable_;
  std::uint32_t order_ = 0;
  std::uint64_t met_ = 0;  // states
  std::uint64_t looked_up_ = 0;
  bool started_ = false, found_ = false;
};

}  // namespace stepwright::pddl

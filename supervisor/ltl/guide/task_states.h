#pragma once

// States of a task while it is planned: those of its automaton, or of the progression of its formula where an
// automaton would be too large; then only the states that are asked for exist.
//
// Thread rule: one thread at a time. Example:
//   TaskStates states(*task);                       // borrows the automaton
//   std::uint32_t state = states.next(states.start(), label);
//   if (states.accepting(state)) ...

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "supervisor/ltl/automaton/automaton.h"
#include "supervisor/ltl/automaton/progression.h"
#include "supervisor/ltl/syntax/formula.h"

namespace stepwright::ltl {

class TaskStates {
 public:
  // The automaton must outlive this.
  explicit TaskStates(const Automaton& automaton) : automaton_(&automaton) {}
  // Behind the letters that were read already.
  explicit TaskStates(const Formula& formula, const std::vector<Letter>& read = {})
      : progression_(std::make_shared<Progression>(formula.terms, formula.root, formula.proposition_count())),
        start_(progression_->start()) {
    for (const Letter letter : read) start_ = progression_->next(start_, letter);
  }

  std::uint32_t start() const { return automaton_ != nullptr ? automaton_->initial : start_; }
  std::uint32_t next(std::uint32_t state, Letter letter) const {
    return automaton_ != nullptr ? automaton_->next(state, letter) : progression_->next(state, letter);
  }
  bool accepting(std::uint32_t state) const { return verdict(state) == Verdict::True; }
  // Of a progression only what is already false counts.
  bool rejecting(std::uint32_t state) const { return verdict(state) == Verdict::False; }
  // About how many places are to be entered yet, for a search to prefer states by: an automaton's transitions
  // to acceptance; of a progression the least that its obligations need, each on its own.
  std::uint32_t left(std::uint32_t state) const;
  const Automaton* automaton() const { return automaton_; }
  bool exhausted() const { return progression_ != nullptr && progression_->exhausted(); }

 private:
  Verdict verdict(std::uint32_t state) const {
    return automaton_ != nullptr ? automaton_->verdicts[state] : Progression::verdict(state);
  }

  const Automaton* automaton_ = nullptr;
  struct Needs {
    std::vector<std::uint32_t> of_term;
    std::unordered_map<std::uint32_t, std::uint32_t> of_state;
  };
  std::shared_ptr<Progression> progression_;  // shared by copies, all of one thread
  std::uint32_t start_ = 0;                   // of the progression
  std::shared_ptr<Needs> needs_ = std::make_shared<Needs>();
};

}  // namespace stepwright::ltl

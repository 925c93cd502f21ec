#pragma once

// A formula that moves on with the letters of a word: what is left to be asked of the rest of the word, as a
// Boolean function of obligations. An obligation is a temporal operator or a literal of the formula; the
// functions are shared diagrams, so states are numbers. Nothing is tabulated: only the states that are asked
// for exist.
//
// A state is true or false as soon as that follows from what was read without looking into obligations. For
// co-safe formulas this is the strong semantics of finite words: X and U ask for letters that are there.
// Source: F. Bacchus, F. Kabanza, Planning for Temporally Extended Goals, Annals of Math. and AI 22, 1998.
//
// Thread rule: one thread at a time. Example:
//   Progression task(formula->terms, formula->root, formula->proposition_count());
//   auto state = task.start();
//   state = task.next(state, letter);
//   if (task.verdict(state) == Verdict::True) ...  // and !task.exhausted()

#include <unordered_map>
#include <vector>

#include "supervisor/ltl/automaton/diagram.h"
#include "supervisor/ltl/automaton/verdict.h"
#include "supervisor/ltl/formula/terms.h"

namespace stepwright::ltl {

class Progression {
 public:
  using State = Diagram::Node;
  static constexpr std::size_t kMostNodes = 4'000'000;

  Progression(Terms terms, Term formula, std::size_t propositions, std::size_t most_nodes = kMostNodes);

  State start() const { return _start; }
  State next(State state, Letter letter);
  static Verdict verdict(State state);

  // The states after each letter in one diagram: its upper levels ask for propositions (level = number), what
  // hangs below them are the states.
  Diagram::Node successors(State state);
  bool is_state(Diagram::Node node) const { return _diagram.level(node) >= _propositions; }

  // The state that is satisfied by exactly the words that do not satisfy this one.
  State dual(State state);

  // The obligation that a node of a state asks for, and what it becomes with a letter.
  Term obligation(Diagram::Node node) const {
    return _diagram.level(node) - static_cast<std::uint32_t>(_propositions);
  }
  Diagram::Node change(Term obligation) const { return _change[obligation]; }
  Diagram::Node unchanged(Term obligation) { return variable(obligation); }

  // True when the bound on nodes was met: no answer since then counts.
  bool exhausted() const { return _diagram.exhausted(); }

  const Terms& terms() const { return _terms; }
  Diagram& diagram() { return _diagram; }
  std::size_t propositions() const { return _propositions; }

 private:
  struct Step {
    State state;
    Letter letter;
    bool operator==(const Step&) const = default;
  };
  struct StepHash {
    std::size_t operator()(const Step& s) const {
      return (s.letter * 0x9E3779B97F4A7C15u) ^ (s.letter >> 31) ^ (s.state * 0xC2B2AE3D27D4EB4Fu);
    }
  };

  void require(Term wanted);
  Diagram::Node variable(Term term);
  Diagram::Node change_of(Term term);
  Diagram::Node with(Diagram::Node node, Letter letter) const;
  State next_of(State state, Letter letter, std::unordered_map<State, State>& done);
  State row_after(State state, Letter letter, bool any, std::unordered_map<State, State>& done);

  Terms _terms;
  std::size_t _propositions;
  Diagram _diagram;
  std::vector<bool> _ready;            // of each term: the two below are known
  std::vector<Diagram::Node> _shape;   // of each term: as a function of obligations
  std::vector<Diagram::Node> _change;  // of each term: after a letter
  State _start = Diagram::kTrue;
  std::unordered_map<State, Diagram::Node> _successors;
  std::unordered_map<State, State> _duals;
  std::unordered_map<Step, State, StepHash> _next;
};

}  // namespace stepwright::ltl

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

#include <optional>
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

  State start() const { return start_; }
  State next(State state, Letter letter);
  static Verdict verdict(State state);

  // The states after each letter in one diagram: its upper levels ask for propositions (level = number), what
  // hangs below them are the states.
  Diagram::Node successors(State state);
  bool is_state(Diagram::Node node) const { return diagram_.level(node) >= propositions_; }

  // The state that is satisfied by exactly the words that do not satisfy this one.
  State dual(State state);

  // The obligation that a node of a state asks for, and what it becomes with a letter: as a diagram of
  // propositions and obligations.
  Term obligation(Diagram::Node node) const { return obligations_[diagram_.level(node) - propositions_]; }
  Diagram::Node change(Term obligation);
  Diagram::Node unchanged(Term obligation) { return shape_[obligation]; }

  // True when the bound on nodes was met: no answer since then counts.
  bool exhausted() const { return diagram_.exhausted(); }

  const Terms& terms() const { return terms_; }
  Diagram& diagram() { return diagram_; }
  std::size_t propositions() const { return propositions_; }

 private:
  static constexpr Diagram::Node kUnknown = 0xFFFFFFFF;

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

  struct Row {
    bool any = false;            // |, or &
    std::vector<State> members;  // nodes of one obligation each
    State rest = Diagram::kTrue;
  };

  void require(Term wanted);
  void order(const std::vector<Term>& required);
  Diagram::Node shape_of(Term term);
  void fill(std::vector<Diagram::Node>& changes, Term wanted, std::optional<Letter> letter);
  Diagram::Node change_of(const std::vector<Diagram::Node>& changes, Term term, std::optional<Letter> letter);
  Diagram::Node joined(const std::vector<Diagram::Node>& parts, Term list);
  Diagram::Node change(Term obligation, Letter letter);
  template <typename Known, typename Parts>
  std::vector<State> unknown_below(State state, const Known& known, const Parts& parts) const;
  Row row_of(State state) const;
  State row_after(const Row& row, State rest, Letter letter);
  bool is_variable(State state) const {
    return diagram_.low(state) == Diagram::kFalse && diagram_.high(state) == Diagram::kTrue;
  }
  std::vector<Term> weaker_of(Term term) const;
  bool implies_marked(Term term, std::vector<Term>& marked);
  void drop_implied(std::vector<State>& pieces, bool any);

  Terms terms_;
  std::size_t propositions_;
  Diagram diagram_;
  std::vector<std::uint32_t> level_;   // of each term that is an obligation
  std::vector<Term> obligations_;      // in the order of their levels
  std::vector<Diagram::Node> shape_;   // of each term: as a function of obligations
  std::vector<Diagram::Node> change_;  // of each term: after any letter
  std::unordered_map<Letter, std::vector<Diagram::Node>> changes_;  // of each term: after this letter
  std::vector<std::vector<Term>> weaker_;  // of each term: obligations that it implies
  std::vector<std::uint32_t> mark_;        // of each term: the last row that it stood in
  std::uint32_t stamp_ = 0;
  std::vector<Term> walk_;  // of implies_marked()
  State start_ = Diagram::kTrue;
  std::unordered_map<State, Diagram::Node> successors_;
  std::unordered_map<State, State> duals_;
  std::unordered_map<Step, State, StepHash> next_;
};

}  // namespace stepwright::ltl

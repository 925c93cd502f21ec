#pragma once

// Tree that finds the operators whose preconditions hold: a decision tree over the finite-domain variables,
// every inner node of which looks at one variable and leaves out all operators that want another value of it
// (Helmert 2006, "The Fast Downward planning system", section 5.3.1).
//
// Thread rule: immutable.

#include <vector>

#include "supervisor/pddl/search/space/finite_domains.h"

namespace stepwright::pddl {

class SuccessorTree {
 public:
  SuccessorTree(const GroundTask& task, const FiniteDomains& domains);

  // Calls `visit` with every operator whose positive literals, and negative ones of facts outside groups,
  // hold. What else its precondition says is for the caller to check.
  template <typename Visit>
  void for_each(const Word* state, const FiniteDomains& domains, const Visit& visit) const {
    walk(root_, state, domains, visit);
  }

  // Is there more in the operator's precondition than the tree decides?
  bool undecided(int op) const { return undecided_[static_cast<std::size_t>(op)]; }

 private:
  static constexpr int kNone = -1;
  // The operators that ask nothing more; then one node per value of a variable, and one whatever it is.
  struct Node {
    int first_operator = 0, last_operator = 0;
    int variable = kNone;
    int first_child = 0;  // in children_, by value
    int any = kNone;
  };
  struct Test {
    int variable, value;
    friend auto operator<=>(const Test&, const Test&) = default;
  };
  struct Candidate {
    int op;
    std::vector<Test> tests;
  };

  int build(std::vector<Candidate>::iterator begin, std::vector<Candidate>::iterator end, std::size_t depth,
            const FiniteDomains& domains);
  Node node_of(std::vector<Candidate>::iterator& begin, std::vector<Candidate>::iterator end,
               std::size_t depth, const FiniteDomains& domains);

  template <typename Visit>
  void walk(int at, const Word* state, const FiniteDomains& domains, const Visit& visit) const {
    for (; at != kNone; at = nodes_[static_cast<std::size_t>(at)].any) {
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      for (int i = node.first_operator; i < node.last_operator; ++i)
        visit(operators_[static_cast<std::size_t>(i)]);
      if (node.variable == kNone) return;
      const int value = domains.value(state, static_cast<std::size_t>(node.variable));
      const int child = children_[static_cast<std::size_t>(node.first_child + value)];
      if (child != kNone) walk(child, state, domains, visit);
    }
  }

  std::vector<Node> nodes_;
  std::vector<int> children_;
  std::vector<int> operators_;
  std::vector<bool> undecided_;
  int root_ = kNone;
};

}  // namespace stepwright::pddl

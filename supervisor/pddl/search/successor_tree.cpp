#include "supervisor/pddl/search/successor_tree.h"

#include <algorithm>

namespace stepwright::pddl {

SuccessorTree::SuccessorTree(const GroundTask& task, const FiniteDomains& domains) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    const Condition& condition = task.operators[i].precondition;
    Candidate candidate{static_cast<int>(i), {}};
    bool rest = condition.impossible || !condition.comparisons.empty() || !condition.choices.empty();
    for (const int literal : condition.literals) {
      const int variable = domains.variable_of(literal / 2);
      const DomainVariable& v = domains[static_cast<std::size_t>(variable)];
      const bool positive = literal % 2 == 0;
      if (positive || v.count == 1) {
        candidate.tests.push_back({variable, positive ? literal / 2 - v.first : v.count});
      } else {
        rest = true;
      }
    }
    std::sort(candidate.tests.begin(), candidate.tests.end());
    const auto twice = std::unique(candidate.tests.begin(), candidate.tests.end());
    candidate.tests.erase(twice, candidate.tests.end());
    candidates.push_back(std::move(candidate));
    undecided_.push_back(rest);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.tests < b.tests; });
  if (!candidates.empty()) root_ = build(candidates.begin(), candidates.end(), 0, domains);
}

// The candidates are sorted and agree on their first `depth` tests. Those without a further test come first,
// those whose next test is on the lowest variable follow; the rest goes to `any`.
int SuccessorTree::build(std::vector<Candidate>::iterator begin, std::vector<Candidate>::iterator end,
                         std::size_t depth, const FiniteDomains& domains) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.first_operator = static_cast<int>(operators_.size());
  while (begin != end && begin->tests.size() == depth) operators_.push_back(begin++->op);
  node.last_operator = static_cast<int>(operators_.size());
  if (begin != end) {
    node.variable = begin->tests[depth].variable;
    node.first_child = static_cast<int>(children_.size());
    const int values = domains[static_cast<std::size_t>(node.variable)].count + 1;
    children_.resize(children_.size() + static_cast<std::size_t>(values), kNone);
    while (begin != end && begin->tests[depth].variable == node.variable) {
      const Test test = begin->tests[depth];
      const auto next = std::find_if(begin, end, [&](const Candidate& c) { return c.tests[depth] != test; });
      const int child = build(begin, next, depth + 1, domains);
      children_[static_cast<std::size_t>(node.first_child + test.value)] = child;
      begin = next;
    }
    if (begin != end) node.any = build(begin, end, depth, domains);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

}  // namespace stepwright::pddl

#include "supervisor/pddl/search/space/successor_tree.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// Of one operator: the tree is so deep, and its making and its use go as deep as it.
constexpr std::size_t kMostTests = 256;

}  // namespace

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
    if (candidate.tests.size() > kMostTests) {
      candidate.tests.resize(kMostTests);
      rest = true;
    }
    candidates.push_back(std::move(candidate));
    undecided_.push_back(rest);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.tests < b.tests; });
  if (!candidates.empty()) root_ = build(candidates.begin(), candidates.end(), 0, domains);
}

// The candidates are sorted and agree on their first `depth` tests. Those without a further test come first,
// those whose next test is on the lowest variable follow; the rest goes to `any`. There may be as many of
// those in a row as there are variables, so they are made in a loop.
int SuccessorTree::build(std::vector<Candidate>::iterator begin, std::vector<Candidate>::iterator end,
                         std::size_t depth, const FiniteDomains& domains) {
  const auto first = static_cast<int>(nodes_.size());
  for (int before = kNone; before == kNone || begin != end;) {
    const auto index = static_cast<int>(nodes_.size());
    if (before != kNone) nodes_[static_cast<std::size_t>(before)].any = index;
    nodes_.emplace_back();
    nodes_[static_cast<std::size_t>(index)] = node_of(begin, end, depth, domains);
    before = index;
  }
  return first;
}

// Takes its candidates off the front.
SuccessorTree::Node SuccessorTree::node_of(std::vector<Candidate>::iterator& begin,
                                           std::vector<Candidate>::iterator end, std::size_t depth,
                                           const FiniteDomains& domains) {
  Node node;
  node.first_operator = static_cast<int>(operators_.size());
  while (begin != end && begin->tests.size() == depth) operators_.push_back(begin++->op);
  node.last_operator = static_cast<int>(operators_.size());
  if (begin == end) return node;
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
  return node;
}

}  // namespace stepwright::pddl

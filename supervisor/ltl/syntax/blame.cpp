#include <set>
#include <utility>

#include "supervisor/ltl/syntax/formula.h"

namespace stepwright::ltl {

namespace {

bool makes_release(Operator op, bool positive) {
  switch (op) {
    case Operator::Always:
    case Operator::Release:
    case Operator::WeakUntil:
      return positive;
    case Operator::Eventually:
    case Operator::Until:
    case Operator::StrongRelease:
      return !positive;
    default:
      return false;
  }
}

}  // namespace

SyntaxId not_cosafe_part(const Formula& formula) {
  std::vector<std::pair<SyntaxId, bool>> open = {{formula.tree.root, true}};
  std::set<std::pair<SyntaxId, bool>> seen;
  while (!open.empty()) {
    const auto [id, positive] = open.back();
    open.pop_back();
    const Term term = positive ? formula.positive[id] : formula.negative[id];
    if (!formula.terms.has_release(term) || !seen.insert({id, positive}).second) continue;
    const SyntaxNode& node = formula.tree.nodes[id];
    if (makes_release(node.op, positive)) return id;
    for (std::size_t k = node.children.size(); k-- > 0;) {
      const bool flips = node.op == Operator::Not || (node.op == Operator::Implies && k == 0);
      open.emplace_back(node.children[k], positive != flips);
      if (node.op == Operator::Xor || node.op == Operator::Iff)
        open.emplace_back(node.children[k], !positive);
    }
  }
  return formula.tree.root;
}

}  // namespace stepwright::ltl

#include "supervisor/ltl/syntax/syntax_tree.h"

#include <utility>

namespace stepwright::ltl {

SyntaxId SyntaxTree::add(Operator op, std::vector<SyntaxId> children, Place at) {
  SyntaxNode node;
  node.op = op;
  node.children = std::move(children);
  node.at = at;
  nodes.push_back(std::move(node));
  return static_cast<SyntaxId>(nodes.size() - 1);
}

std::vector<SyntaxId> conjuncts(const SyntaxTree& tree) {
  std::vector<SyntaxId> open = {tree.root}, parts;
  while (!open.empty()) {
    const SyntaxId id = open.back();
    open.pop_back();
    const SyntaxNode& node = tree.nodes[id];
    if (node.op == Operator::And)
      open.insert(open.end(), node.children.rbegin(), node.children.rend());
    else
      parts.push_back(id);
  }
  return parts;
}

const Timed* timed_of(const SyntaxTree& tree, std::uint32_t proposition) {
  for (const Timed& each : tree.timed)
    if (each.proposition == proposition) return &each;
  return nullptr;
}

}  // namespace stepwright::ltl

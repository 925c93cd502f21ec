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

}  // namespace stepwright::ltl

#include "supervisor/ltl/automaton/diagram.h"

#include <algorithm>

namespace stepwright::ltl {

Diagram::Diagram(std::size_t most_nodes) : _most(most_nodes) {
  _nodes.resize(2);
}

Diagram::Node Diagram::make(std::uint32_t level, Node low, Node high) {
  if (low == high) return low;
  const Triple triple{level, low, high};
  if (const auto known = _unique.find(triple); known != _unique.end()) return known->second;
  // What is remembered of answers counts as well: it takes the same memory.
  if (_nodes.size() >= _most || _chosen.size() >= 4 * _most) {
    _exhausted = true;
    return kFalse;
  }
  const auto node = static_cast<Node>(_nodes.size());
  _nodes.push_back(triple);
  _unique.emplace(triple, node);
  return node;
}

Diagram::Node Diagram::variable(std::uint32_t level) {
  return make(level, kFalse, kTrue);
}

Diagram::Node Diagram::choose(Node condition, Node then, Node otherwise) {
  if (_exhausted) return kFalse;
  if (condition == kTrue || then == otherwise) return then;
  if (condition == kFalse) return otherwise;
  if (then == kTrue && otherwise == kFalse) return condition;
  if (then == condition) then = kTrue;
  if (otherwise == condition) otherwise = kFalse;
  const Triple question{condition, otherwise, then};
  if (const auto known = _chosen.find(question); known != _chosen.end()) return known->second;
  const std::uint32_t top = std::min({level(condition), level(then), level(otherwise)});
  const auto part = [&](Node node, bool value) {
    return level(node) != top ? node : value ? high(node) : low(node);
  };
  const Node no = choose(part(condition, false), part(then, false), part(otherwise, false));
  const Node yes = choose(part(condition, true), part(then, true), part(otherwise, true));
  const Node answer = make(top, no, yes);
  if (!_exhausted) _chosen.emplace(question, answer);
  return answer;
}

}  // namespace stepwright::ltl

#pragma once

// Binary decision diagrams, reduced and shared: equal functions are equal numbers. Variables are tested in
// the order of their levels, the smallest first. There is a bound on the nodes; beyond it every answer is
// false, and exhausted() says that none of them counts.
//
// Source: R. Bryant, Graph-Based Algorithms for Boolean Function Manipulation, IEEE Trans. Computers 35(8),
// 1986. Thread rule: one thread at a time.

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace stepwright::ltl {

class Diagram {
 public:
  using Node = std::uint32_t;
  static constexpr Node kFalse = 0;
  static constexpr Node kTrue = 1;
  static constexpr std::uint32_t kNoLevel = 0xFFFFFFFF;  // of the constants

  explicit Diagram(std::size_t most_nodes);

  Node variable(std::uint32_t level);
  Node negation(Node a) { return choose(a, kFalse, kTrue); }
  Node both(Node a, Node b) { return choose(a, b, kFalse); }
  Node either(Node a, Node b) { return choose(a, kTrue, b); }
  Node choose(Node condition, Node then, Node otherwise);

  // Requires a level above those of both parts.
  Node make(std::uint32_t level, Node low, Node high);

  std::uint32_t level(Node node) const { return _nodes[node].level; }
  Node low(Node node) const { return _nodes[node].low; }    // where the variable is false
  Node high(Node node) const { return _nodes[node].high; }  // where it is true

  bool exhausted() const { return _exhausted; }

 private:
  struct Triple {
    std::uint32_t level = kNoLevel;
    Node low = 0, high = 0;
    bool operator==(const Triple&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Triple& t) const {
      std::uint64_t hash = (std::uint64_t{t.low} << 32 | t.high) * 0x9E3779B97F4A7C15u;
      hash ^= (hash >> 32) + t.level * 0xC2B2AE3D27D4EB4Fu;
      return hash * 0x9E3779B97F4A7C15u >> 7;
    }
  };

  std::size_t _most;
  bool _exhausted = false;
  std::vector<Triple> _nodes;
  std::unordered_map<Triple, Node, Hash> _unique;
  std::unordered_map<Triple, Node, Hash> _chosen;  // condition, otherwise, then
};

}  // namespace stepwright::ltl

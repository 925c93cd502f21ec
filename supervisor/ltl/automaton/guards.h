#pragma once

// The edges of an automaton as decision diagrams of letters with states at their ends: each node asks for one
// proposition, equal parts are stored once. A state with many propositions needs no row per letter.
//
// Thread rule: const functions from any thread.

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "supervisor/ltl/automaton/verdict.h"

namespace stepwright::ltl {

// A state (the highest bit is set) or a node.
using Guard = std::uint32_t;
inline constexpr Guard kStateBit = 0x80000000;
constexpr Guard guard_of_state(std::uint32_t state) {
  return state | kStateBit;
}
constexpr bool is_state(Guard guard) {
  return (guard & kStateBit) != 0;
}
constexpr std::uint32_t state_of(Guard guard) {
  return guard & ~kStateBit;
}

struct GuardNode {
  std::uint32_t proposition = 0;
  Guard low = 0;   // where the proposition does not hold
  Guard high = 0;  // where it holds
  bool operator==(const GuardNode&) const = default;
};

// Children lie before their parents; propositions are asked for in the order of their numbers.
class Guards {
 public:
  Guard make(std::uint32_t proposition, Guard low, Guard high);

  const std::vector<GuardNode>& nodes() const { return nodes_; }
  std::uint32_t next(Guard from, Letter letter) const;

  // Adds each state that the guard leads to, once, in the order of low before high.
  void collect(Guard from, std::vector<std::uint32_t>& states) const;

  bool operator==(const Guards& other) const { return nodes_ == other.nodes_; }

 private:
  struct Hash {
    std::size_t operator()(const GuardNode& n) const {
      return ((std::uint64_t{n.low} << 32 | n.high) * 0x9E3779B97F4A7C15u) ^
             (n.proposition * 0xC2B2AE3D27D4EB4Fu);
    }
  };
  std::vector<GuardNode> nodes_;
  std::unordered_map<GuardNode, Guard, Hash> unique_;
};

// A guard with other states at its ends, written into other guards.
class GuardRewriter {
 public:
  GuardRewriter(const Guards& from, Guards& to, const std::vector<std::uint32_t>& states)
      : from_(from), to_(to), states_(states) {}
  Guard operator()(Guard guard);

 private:
  const Guards& from_;
  Guards& to_;
  const std::vector<std::uint32_t>& states_;
  std::unordered_map<Guard, Guard> done_;
};

}  // namespace stepwright::ltl

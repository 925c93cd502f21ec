#pragma once

// All stacks that one function's code can have, as a tree: a state is a node, its type is the top of the
// stack, its parent the stack below. Equal stacks are the same node, so that a join compares two numbers.
// The nodes lie in memory of the caller (kNodeWords each).

#include <cstdint>
#include <span>

#include "runtime/bytecode/value_type.h"

namespace stepwright::bytecode {

class StackStates {
 public:
  using State = std::uint32_t;
  static constexpr State kNone = 0;
  static constexpr State kEmpty = 1;
  static constexpr std::uint32_t kNodeWords = 4;

  // Requires memory for two nodes at least.
  explicit StackStates(std::span<std::uint32_t> memory) : memory_(memory) {
    for (std::uint32_t i = 0; i < 2 * kNodeWords; ++i) memory_[i] = 0;
    used_ = 2;
  }

  std::uint32_t depth(State state) const { return node(state, kDepthAndType) >> 8; }

  // The type on top; requires a state that is not empty.
  StackType top(State state) const { return static_cast<StackType>(node(state, kDepthAndType) & 0xFF); }

  State pop(State state) const { return node(state, kParent); }

  // kNone if the memory is used up.
  State push(State state, StackType type) {
    for (State child = node(state, kFirstChild); child != kNone; child = node(child, kSibling)) {
      if (top(child) == type) return child;
    }
    if ((used_ + 1) * std::uint64_t{kNodeWords} > memory_.size()) return kNone;
    const State child = used_++;
    node(child, kParent) = state;
    node(child, kFirstChild) = kNone;
    node(child, kSibling) = node(state, kFirstChild);
    node(child, kDepthAndType) = ((depth(state) + 1) << 8) | static_cast<std::uint32_t>(type);
    node(state, kFirstChild) = child;
    return child;
  }

 private:
  enum Field : std::uint32_t { kParent, kFirstChild, kSibling, kDepthAndType };

  std::uint32_t& node(State state, Field field) { return memory_[state * kNodeWords + field]; }
  std::uint32_t node(State state, Field field) const { return memory_[state * kNodeWords + field]; }

  std::span<std::uint32_t> memory_;
  std::uint32_t used_ = 0;
};

}  // namespace stepwright::bytecode

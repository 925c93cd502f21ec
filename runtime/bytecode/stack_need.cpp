#include "runtime/bytecode/stack_need.h"

#include "runtime/bytecode/instruction.h"

namespace stepwright::bytecode {

namespace {

struct Need {
  std::uint32_t slots = 0;
  std::uint32_t depth = 0;
};

std::uint32_t larger(std::uint32_t a, std::uint32_t b) {
  return a > b ? a : b;
}

// The largest need of the functions that this one calls, as far as known.
Need callees(const ContainerView& view, const FunctionRecord& function,
             std::span<const std::uint32_t> known) {
  Need need;
  const auto code = view.code(function);
  Instruction in;
  for (std::uint32_t pc = 0; pc < code.size() && decode(code, pc, in); pc += in.size) {
    if (!is_call(in.opcode)) continue;
    need.slots = larger(need.slots, known[in.a * 2]);
    need.depth = larger(need.depth, known[in.a * 2 + 1]);
  }
  return need;
}

// Raises every function's need to what its callees ask for; false when nothing changed.
bool raise_needs(const ContainerView& view, std::span<std::uint32_t> known) {
  bool changed = false;
  for (std::uint32_t f = 0; f < view.count<Section::Functions>(); ++f) {
    const FunctionRecord function = view.record<Section::Functions>(f);
    const Need below = callees(view, function, known);
    const std::uint32_t slots = function.local_count + kFrameSlots + function.max_stack + below.slots;
    changed = changed || slots != known[f * 2] || below.depth + 1 != known[f * 2 + 1];
    known[f * 2] = slots;
    known[f * 2 + 1] = below.depth + 1;
  }
  return changed;
}

}  // namespace

StackNeed compute_stack_need(const ContainerView& view, std::span<std::uint32_t> scratch) {
  const std::uint32_t count = view.count<Section::Functions>();
  if (scratch.size() < stack_need_words(count))
    return {{VerifyStatus::ScratchTooSmall, Section::Functions, 0, 0}};
  const auto known = scratch.first(std::size_t{count} * 2);
  for (std::uint32_t& word : known) word = 0;

  // An acyclic graph is settled after as many rounds as its longest chain; a cycle never settles.
  std::uint32_t rounds = 0;
  while (raise_needs(view, known)) {
    if (++rounds > kMaxCallDepth) {
      std::uint32_t deepest = 0;
      for (std::uint32_t f = 0; f < count; ++f) {
        if (known[f * 2 + 1] > known[deepest * 2 + 1]) deepest = f;
      }
      return {{VerifyStatus::Recursion, Section::Functions, deepest, 0}};
    }
  }

  // Those that nothing calls, too: an engine that makes code sets slots aside for all.
  for (std::uint32_t f = 0; f < count; ++f) {
    if (known[f * 2] > kMaxStackSlots) return {{VerifyStatus::TooLarge, Section::Functions, f, 0}};
  }
  StackNeed need;
  for (std::uint32_t i = 0; i < view.count<Section::ProgramCalls>(); ++i) {
    const std::uint32_t f = view.record<Section::ProgramCalls>(i).function;
    need.stack_slots = larger(need.stack_slots, known[f * 2]);
    need.call_depth = larger(need.call_depth, known[f * 2 + 1]);
  }
  return need;
}

}  // namespace stepwright::bytecode

#include "runtime/native/internal/function_code.h"

#include <cstring>

namespace stepwright::native {

using bytecode::FunctionRecord;
using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::Section;

namespace {

template <typename Info>
StackEffect effect_of(const Info& info) {
  return {static_cast<std::uint32_t>(std::strlen(info.pops)),
          static_cast<std::uint32_t>(std::strlen(info.pushes))};
}

// A pair of boolean instructions is what it replaces: a load or the value on the stack, an operation, and a
// negation or a store.
struct Pair {
  Opcode first = Opcode::Return;  // opcodes of the mode Abs; those of This follow them
  Opcode second = Opcode::Return;
  bool negated = false;
};

Pair parts_of(Opcode pair) {
  switch (pair) {
    case Opcode::LoadAndBoolAbs:
      return {Opcode::LoadBoolAbs, Opcode::AndBoolAbs};
    case Opcode::LoadOrBoolAbs:
      return {Opcode::LoadBoolAbs, Opcode::OrBoolAbs};
    case Opcode::LoadAndNotBoolAbs:
      return {Opcode::LoadBoolAbs, Opcode::AndNotBoolAbs};
    case Opcode::LoadOrNotBoolAbs:
      return {Opcode::LoadBoolAbs, Opcode::OrNotBoolAbs};
    case Opcode::LoadNorBoolAbs:
      return {Opcode::LoadBoolAbs, Opcode::OrBoolAbs, true};
    case Opcode::LoadNandBoolAbs:
      return {Opcode::LoadBoolAbs, Opcode::AndBoolAbs, true};
    case Opcode::AndStoreBoolAbs:
      return {Opcode::AndBoolAbs, Opcode::StoreBoolAbs};
    case Opcode::OrStoreBoolAbs:
      return {Opcode::OrBoolAbs, Opcode::StoreBoolAbs};
    case Opcode::AndNotStoreBoolAbs:
      return {Opcode::AndNotBoolAbs, Opcode::StoreBoolAbs};
    case Opcode::OrNotStoreBoolAbs:
      return {Opcode::OrNotBoolAbs, Opcode::StoreBoolAbs};
    case Opcode::MoveBoolAbs:
      return {Opcode::LoadBoolAbs, Opcode::StoreBoolAbs};
    default:
      return {Opcode::LoadNotBoolAbs, Opcode::StoreBoolAbs};
  }
}

Opcode next(Opcode opcode, std::uint8_t by) {
  return static_cast<Opcode>(static_cast<std::uint8_t>(opcode) + by);
}

// Appends the instruction; of a pair, its parts, which share its place. Nothing jumps between them, and none
// of them traps.
void append(std::vector<FunctionCode::Item>& items, const FunctionCode::Item& item) {
  items.push_back(item);
  const Instruction& whole = item.instruction;
  if (bytecode::info(whole.opcode).operands != bytecode::Operands::TwoU32) return;
  const std::uint8_t mode = bytecode::is_this_boolean(whole.opcode) ? 1 : 0;
  const Pair pair = parts_of(static_cast<Opcode>(static_cast<std::uint8_t>(whole.opcode) - mode));
  items.back().instruction = {.opcode = next(pair.first, mode), .size = whole.size, .a = whole.a};
  items.push_back(
      {.instruction = {.opcode = next(pair.second, mode), .size = whole.size, .a = whole.b}, .pc = item.pc});
  if (pair.negated) items.push_back({.instruction = {.opcode = Opcode::NotBool}, .pc = item.pc});
}

}  // namespace

FunctionCode decode_function(const bytecode::ContainerView& view, std::uint32_t function) {
  FunctionCode out;
  out.record = view.record<Section::Functions>(function);
  const auto code = view.code(out.record);
  std::vector<std::uint32_t> index_at(code.size(), kNoInstruction);
  for (std::uint32_t pc = 0; pc < code.size();) {
    FunctionCode::Item item;
    if (!bytecode::decode(code, pc, item.instruction)) break;  // a verified function has no such byte
    item.pc = pc;
    index_at[pc] = static_cast<std::uint32_t>(out.items.size());
    pc += item.instruction.size;
    append(out.items, item);
  }
  for (FunctionCode::Item& item : out.items) {
    if (!is_jump(item.instruction.opcode)) continue;
    const auto target = item.pc + item.instruction.size + static_cast<std::uint32_t>(item.instruction.a);
    item.target = index_at[target];
    out.items[item.target].is_target = true;
  }
  return out;
}

StackEffect stack_effect(const bytecode::ContainerView& view, const FunctionRecord& function,
                         const Instruction& in) {
  switch (in.opcode) {
    case Opcode::LocalGet:
      return {0, 1};
    case Opcode::LocalSet:
    case Opcode::Drop:
      return {1, 0};
    case Opcode::Dup:
      return {1, 2};
    case Opcode::Select:
      return {3, 1};
    case Opcode::Call: {
      const FunctionRecord callee = view.record<Section::Functions>(in.a);
      return {callee.param_count, callee.result == bytecode::kNoResult ? 0u : 1u};
    }
    case Opcode::Return:
      return {function.result == bytecode::kNoResult ? 0u : 1u, 0};
    case Opcode::Intrinsic:
      return effect_of(bytecode::kIntrinsics[in.a]);
    case Opcode::StringOp:
      return effect_of(bytecode::kStringOps[in.a]);
    default:
      return effect_of(bytecode::info(in.opcode));
  }
}

}  // namespace stepwright::native

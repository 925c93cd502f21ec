#include "runtime/native/internal/function_code.h"

#include "runtime/bytecode/boolean_pair.h"

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
    if (bytecode::is_boolean_pair(item.instruction.opcode)) {
      for (const Instruction& each : bytecode::unfold(item.instruction)) out.items.push_back({each, item.pc});
    } else {
      out.items.push_back(item);
    }
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

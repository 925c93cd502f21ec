#include "firmware/app/operation_set.h"

#include "runtime/bytecode/instruction.h"

namespace stepwright::app {
namespace {

using bytecode::IntrinsicId;
using bytecode::Opcode;
using bytecode::Section;

bool is_basic(const bytecode::Instruction& in) {
  if (in.opcode == Opcode::StringOp) return false;
  // The elementary functions are the last of the list.
  return in.opcode != Opcode::Intrinsic || in.a <= static_cast<std::uint32_t>(IntrinsicId::MaxF64);
}

bool is_basic(std::span<const std::byte> code) {
  bytecode::Instruction in;
  for (std::uint32_t pc = 0; pc < code.size() && bytecode::decode(code, pc, in); pc += in.size) {
    if (!is_basic(in)) return false;
  }
  return true;
}

}  // namespace

bool is_basic(const bytecode::Program& program) {
  const bytecode::ContainerView& view = program.container();
  for (std::uint32_t f = 0; f < view.count<Section::Functions>(); ++f) {
    if (!is_basic(view.code(view.record<Section::Functions>(f)))) return false;
  }
  return true;
}

}  // namespace stepwright::app

#pragma once

// One function's bytecode, decoded: its instructions, where jumps lead, and how deep the operand stack is.

#include <cstdint>
#include <cstring>
#include <vector>

#include "runtime/bytecode/instruction.h"
#include "runtime/bytecode/program.h"

namespace stepwright::native {

inline constexpr bytecode::IntrinsicId kFirstElementary = bytecode::IntrinsicId::SinF32;
inline constexpr std::uint32_t kNoInstruction = 0xFFFFFFFF;

struct FunctionCode {
  struct Item {
    bytecode::Instruction instruction;
    std::uint32_t pc = 0;
    std::uint32_t target = kNoInstruction;  // index of the instruction that a jump leads to
    bool is_target = false;                 // some jump leads here
  };

  bytecode::FunctionRecord record;
  std::vector<Item> items;
};

// Numbers of stack slots that an instruction pops and pushes.
struct StackEffect {
  std::uint32_t pops = 0;
  std::uint32_t pushes = 0;
};

// A letter of an opcode's effect: "b" is Bool.
inline bytecode::StackType type_named(char name) {
  constexpr const char* kNames = "bilfdr";
  return static_cast<bytecode::StackType>(std::strchr(kNames, name) - kNames);
}
static_assert(static_cast<int>(bytecode::StackType::Bool) == 0 &&
              static_cast<int>(bytecode::StackType::Ref) == 5);

FunctionCode decode_function(const bytecode::ContainerView& view, std::uint32_t function);

StackEffect stack_effect(const bytecode::ContainerView& view, const bytecode::FunctionRecord& function,
                         const bytecode::Instruction& instruction);

constexpr bool is_jump(bytecode::Opcode opcode) {
  using bytecode::Opcode;
  return opcode == Opcode::Jump || opcode == Opcode::JumpIfFalse || opcode == Opcode::JumpIfTrue;
}

// The work is done by a function of the library.
constexpr bool calls_library(const bytecode::Instruction& in) {
  using bytecode::Opcode;
  return in.opcode == Opcode::StringOp ||
         (in.opcode == Opcode::Intrinsic && static_cast<bytecode::IntrinsicId>(in.a) >= kFirstElementary);
}

// Nothing runs on from here to the next instruction.
constexpr bool ends_block(bytecode::Opcode opcode) {
  using bytecode::Opcode;
  return opcode == Opcode::Jump || opcode == Opcode::Return || opcode == Opcode::Trap;
}

using bytecode::is_call;

// A load or store of one of the memory types in one of the address modes.
struct MemoryAccess {
  bytecode::MemType type = bytecode::MemType::Bool;
  bytecode::AddressMode mode = bytecode::AddressMode::Abs;
  bool store = false;
};

constexpr bool is_memory_access(bytecode::Opcode opcode) {
  return opcode >= bytecode::Opcode::LoadBoolAbs && opcode <= bytecode::Opcode::StoreRefInd;
}

// Requires is_memory_access.
constexpr MemoryAccess memory_access(bytecode::Opcode opcode) {
  const auto number =
      static_cast<std::uint32_t>(opcode) - static_cast<std::uint32_t>(bytecode::Opcode::LoadBoolAbs);
  return {static_cast<bytecode::MemType>(number / 3 % bytecode::kMemTypeCount),
          static_cast<bytecode::AddressMode>(number % 3), opcode >= bytecode::Opcode::StoreBoolAbs};
}

}  // namespace stepwright::native

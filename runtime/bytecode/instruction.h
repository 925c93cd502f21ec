#pragma once

// One decoded instruction.

#include <cstdint>
#include <cstring>
#include <span>

#include "runtime/bytecode/opcode.h"

namespace stepwright::bytecode {

struct Instruction {
  Opcode opcode = Opcode::Return;
  std::uint32_t size = 1;  // opcode and operands in bytes
  std::uint32_t a = 0;     // first operand (a jump distance: as i32)
  std::uint32_t b = 0;     // second
  std::uint32_t c = 0;     // third

  std::int32_t signed_a() const { return static_cast<std::int32_t>(a); }
  std::int32_t signed_b() const { return static_cast<std::int32_t>(b); }
};

// Decodes the instruction at `pc`; false if it is no opcode (size 0) or cut off by the end of `code` (size as
// it should be).
inline bool decode(std::span<const std::byte> code, std::uint32_t pc, Instruction& out) {
  const auto byte = static_cast<std::uint8_t>(code[pc]);
  out = {.size = 0};
  if (byte >= kOpcodeCount) return false;
  out.opcode = static_cast<Opcode>(byte);
  out.size = instruction_size(out.opcode);
  if (out.size > code.size() - pc) return false;
  const std::byte* at = code.data() + pc + 1;
  switch (info(out.opcode).operands) {
    case Operands::None:
      break;
    case Operands::U8:
      out.a = static_cast<std::uint8_t>(*at);
      break;
    case Operands::U32:
    case Operands::I32:
      std::memcpy(&out.a, at, 4);
      break;
    case Operands::ByteBit:
      std::memcpy(&out.a, at, 4);
      out.b = static_cast<std::uint8_t>(at[4]);
      break;
    case Operands::FunctionAddress:
    case Operands::Bounds:
    case Operands::Constants:
    case Operands::TwoU32:
      std::memcpy(&out.a, at, 4);
      std::memcpy(&out.b, at + 4, 4);
      break;
    case Operands::Range:
      std::memcpy(&out.a, at, 4);
      std::memcpy(&out.b, at + 4, 4);
      std::memcpy(&out.c, at + 8, 4);
      break;
  }
  return true;
}

}  // namespace stepwright::bytecode

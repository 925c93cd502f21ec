#pragma once

// Opcodes, their operands and their effect on the typed operand stack.
// An instruction is one opcode byte followed by its operands, little-endian and unaligned.

#include <array>
#include <cstdint>

#include "runtime/bytecode/opcode_list.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::bytecode {

enum class Opcode : std::uint8_t {
#define STEPWRIGHT_X(name, operands, pops, pushes) name,
  STEPWRIGHT_OPCODES(STEPWRIGHT_X)
#undef STEPWRIGHT_X
};

enum class IntrinsicId : std::uint8_t {
#define STEPWRIGHT_X(name, pops, pushes) name,
  STEPWRIGHT_INTRINSICS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
};

enum class StringOpId : std::uint8_t {
#define STEPWRIGHT_X(name, pops, pushes) name,
  STEPWRIGHT_STRING_OPS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
};

// The operand bytes after an opcode.
enum class Operands : std::uint8_t {
  None,             // -
  U8,               // u8
  U32,              // u32
  I32,              // i32: jump distance in bytes from the end of the instruction
  ByteBit,          // u32 byte offset into the image, u8 bit 0..7
  FunctionAddress,  // u32 function, u32 byte offset of the instance
  Range,            // i32 lower, i32 upper, u32 stride in bytes
  Bounds,           // i32 lower, i32 upper
  Constants,        // u32 constant of the lower bound, u32 constant of the upper bound
  TwoU32,           // u32, u32: two offsets of BOOLs
};

struct OpcodeInfo {
  const char* name;
  Operands operands;
  const char* pops;  // stack types, deepest first; "*" = depends on an operand
  const char* pushes;
};

// An entry of a second-level list: an intrinsic, or an operation of StringOp.
struct OperationInfo {
  const char* name;
  const char* pops;
  const char* pushes;
};

inline constexpr auto kOpcodes = std::to_array<OpcodeInfo>({
#define STEPWRIGHT_X(name, operands, pops, pushes) {#name, Operands::operands, pops, pushes},
    STEPWRIGHT_OPCODES(STEPWRIGHT_X)
#undef STEPWRIGHT_X
});

inline constexpr auto kIntrinsics = std::to_array<OperationInfo>({
#define STEPWRIGHT_X(name, pops, pushes) {#name, pops, pushes},
    STEPWRIGHT_INTRINSICS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
});

inline constexpr auto kStringOps = std::to_array<OperationInfo>({
#define STEPWRIGHT_X(name, pops, pushes) {#name, pops, pushes},
    STEPWRIGHT_STRING_OPS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
});

// The test of a text before a To... reads it, and back; of the same width.
constexpr StringOpId test_of(StringOpId to) {
  const int distance = static_cast<int>(to) - static_cast<int>(StringOpId::ToBoolS);
  return static_cast<StringOpId>(static_cast<int>(StringOpId::IsBoolS) + distance / 4 * 2 + distance % 2);
}
constexpr StringOpId tested_by(StringOpId test) {
  const int distance = static_cast<int>(test) - static_cast<int>(StringOpId::IsBoolS);
  return static_cast<StringOpId>(static_cast<int>(StringOpId::ToBoolS) + distance / 2 * 4 + distance % 2);
}
constexpr bool is_test(StringOpId id) {
  return id >= StringOpId::IsBoolS;
}
static_assert(test_of(StringOpId::ToDtW) == StringOpId::IsDtW &&
              tested_by(StringOpId::IsDtW) == StringOpId::ToDtW);

inline constexpr std::uint32_t kOpcodeCount = kOpcodes.size();
inline constexpr std::uint32_t kIntrinsicCount = kIntrinsics.size();
inline constexpr std::uint32_t kStringOpCount = kStringOps.size();
static_assert(kOpcodeCount <= 256, "an opcode is one byte");

// Requires a valid opcode (< kOpcodeCount).
constexpr const OpcodeInfo& info(Opcode opcode) {
  return kOpcodes[static_cast<std::uint8_t>(opcode)];
}

// True for the instructions whose first operand is a function.
constexpr bool is_call(Opcode opcode) {
  return opcode >= Opcode::Call && opcode <= Opcode::CallInstanceInd;
}
static_assert(static_cast<int>(Opcode::CallInstanceInd) - static_cast<int>(Opcode::Call) == 3);

// True for AndBoolAbs and its kind, one operand or two, which come in both modes: Abs, then This.
constexpr bool is_fused_boolean(Opcode opcode) {
  return opcode >= Opcode::LoadNotBoolAbs && opcode <= Opcode::MoveNotBoolThis;
}
constexpr bool is_this_boolean(Opcode opcode) {
  return (static_cast<std::uint8_t>(opcode) - static_cast<std::uint8_t>(Opcode::LoadNotBoolAbs)) % 2 == 1;
}
static_assert(!is_this_boolean(Opcode::XorBoolAbs) && is_this_boolean(Opcode::MoveNotBoolThis));

// Bytes of operands after the opcode byte.
constexpr std::uint32_t size_of(Operands operands) {
  constexpr std::uint8_t kSizes[] = {0, 1, 4, 4, 5, 8, 12, 8, 8, 8};
  return kSizes[static_cast<std::uint8_t>(operands)];
}

constexpr std::uint32_t instruction_size(Opcode opcode) {
  return 1 + size_of(info(opcode).operands);
}

// The load or store of a memory type in an address mode.
constexpr Opcode load_opcode(MemType type, AddressMode mode) {
  return static_cast<Opcode>(static_cast<std::uint8_t>(Opcode::LoadBoolAbs) +
                             static_cast<std::uint8_t>(type) * 3 + static_cast<std::uint8_t>(mode));
}
constexpr Opcode store_opcode(MemType type, AddressMode mode) {
  return static_cast<Opcode>(static_cast<std::uint8_t>(Opcode::StoreBoolAbs) +
                             static_cast<std::uint8_t>(type) * 3 + static_cast<std::uint8_t>(mode));
}
static_assert(load_opcode(MemType::Ref, AddressMode::Ind) == Opcode::LoadRefInd);
static_assert(store_opcode(MemType::F32, AddressMode::This) == Opcode::StoreF32This);

}  // namespace stepwright::bytecode

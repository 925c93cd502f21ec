#pragma once

// The types of values: on the operand stack, in the image, and as IEC 61131-3 names them.
// The numeric values are part of the container format (runtime/doc/bytecode_format.md).

#include <cstdint>

namespace stepwright::bytecode {

// Type of one 64-bit slot of the operand stack or of a function frame. I32 and I64 carry signed and unsigned
// integers alike: the opcode decides. A Ref is a byte offset into the image.
enum class StackType : std::uint8_t { Bool = 0, I32 = 1, I64 = 2, F32 = 3, F64 = 4, Ref = 5 };
inline constexpr std::uint8_t kStackTypeCount = 6;
inline constexpr std::uint8_t kNoResult = 0xFF;  // FunctionRecord::result of a function without a result

// How a value lies in the image, little-endian, at any alignment. Bool is one byte, 0 or 1. I32 serves UDINT
// and DWORD too, I64 serves ULINT, LWORD and TIME (nanoseconds). Ref is 4 bytes.
enum class MemType : std::uint8_t {
  Bool = 0,
  I8 = 1,
  U8 = 2,
  I16 = 3,
  U16 = 4,
  I32 = 5,
  I64 = 6,
  F32 = 7,
  F64 = 8,
  Ref = 9,
};
inline constexpr std::uint8_t kMemTypeCount = 10;

// The Ref that points nowhere, NULL: following it is a Trap. Initialise VAR_IN_OUT slots with it. What lies
// at or behind it (NULL and an offset) is no address of any image either and traps alike.
inline constexpr std::uint32_t kNullRef = 0xFFFFFFFF;

enum class AddressMode : std::uint8_t {
  Abs = 0,   // operand: byte offset into the image
  This = 1,  // operand: byte offset from the base of the running instance
  Ind = 2,   // a Ref on the stack, checked when it is followed
};

// The target of a conversion from a floating-point number: its range decides whether it traps.
enum class IntType : std::uint8_t { I8 = 0, U8 = 1, I16 = 2, U16 = 3, I32 = 4, U32 = 5, I64 = 6, U64 = 7 };
inline constexpr std::uint8_t kIntTypeCount = 8;

// Elementary types of IEC 61131-3 (table 10), for symbols and viewers. The long types of time are the same as
// the short ones: LTIME is Time, LDATE is Date, LTOD is Tod, LDT is Dt. All are int64 nanoseconds: of a
// duration, since 1970-01-01 (Date, Dt), since midnight (Tod).
enum class ElementaryType : std::uint8_t {
  Bool = 0,
  Sint = 1,
  Int = 2,
  Dint = 3,
  Lint = 4,
  Usint = 5,
  Uint = 6,
  Udint = 7,
  Ulint = 8,
  Byte = 9,
  Word = 10,
  Dword = 11,
  Lword = 12,
  Real = 13,
  Lreal = 14,
  Time = 15,
  Date = 16,
  Tod = 17,
  Dt = 18,
  Char = 19,
  Wchar = 20,
  String = 21,  // from here on: not a scalar, TypeKind::String
  Wstring = 22,
};
inline constexpr std::uint8_t kElementaryTypeCount = 23;
inline constexpr std::uint8_t kScalarTypeCount = 21;

constexpr bool is_string(ElementaryType type) {
  return type >= ElementaryType::String;
}

// A STRING or WSTRING lies in memory as u16 capacity, u16 length, then `capacity` characters of u8 or u16;
// both count characters. Its value on the stack is the Ref to this header.
inline constexpr std::uint32_t kStringHeaderBytes = 4;
inline constexpr std::uint32_t kMaxStringCapacity = 0xFFFF;

// Bytes of one character of STRING or WSTRING.
constexpr std::uint32_t character_bytes(ElementaryType type) {
  return type == ElementaryType::Wstring ? 2 : 1;
}
constexpr std::uint32_t string_bytes(ElementaryType type, std::uint32_t capacity) {
  return kStringHeaderBytes + capacity * character_bytes(type);
}

// Bytes in the image: 1, 2, 4 or 8.
constexpr std::uint32_t size_of(MemType type) {
  constexpr std::uint8_t kSizes[kMemTypeCount] = {1, 1, 1, 2, 2, 4, 8, 4, 8, 4};
  return kSizes[static_cast<std::uint8_t>(type)];
}

// The slot that a load of this type pushes and a store pops.
constexpr StackType stack_type(MemType type) {
  constexpr StackType kTypes[kMemTypeCount] = {
      StackType::Bool, StackType::I32, StackType::I32, StackType::I32, StackType::I32,
      StackType::I32,  StackType::I64, StackType::F32, StackType::F64, StackType::Ref};
  return kTypes[static_cast<std::uint8_t>(type)];
}

// The slot that a conversion to this integer pushes.
constexpr StackType stack_type(IntType type) {
  return type < IntType::I64 ? StackType::I32 : StackType::I64;
}

// How a scalar lies in the image. Of a string it is what an operation takes: the Ref to its header.
constexpr MemType mem_type(ElementaryType type) {
  constexpr MemType kTypes[kElementaryTypeCount] = {
      MemType::Bool, MemType::I8,  MemType::I16, MemType::I32, MemType::I64, MemType::U8,
      MemType::U16,  MemType::I32, MemType::I64, MemType::U8,  MemType::U16, MemType::I32,
      MemType::I64,  MemType::F32, MemType::F64, MemType::I64, MemType::I64, MemType::I64,
      MemType::I64,  MemType::U8,  MemType::U16, MemType::Ref, MemType::Ref};
  return kTypes[static_cast<std::uint8_t>(type)];
}

// True for USINT..ULINT, BYTE..LWORD and the characters.
constexpr bool is_unsigned(ElementaryType type) {
  return (type >= ElementaryType::Usint && type <= ElementaryType::Lword) || type == ElementaryType::Char ||
         type == ElementaryType::Wchar;
}

// "BOOL", "SINT", ...
const char* name_of(ElementaryType type);

}  // namespace stepwright::bytecode

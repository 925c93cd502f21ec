#pragma once

// Every opcode as the edge tests run it: its operand bytes, what it pops and what it pushes. An opcode whose
// list entry says all that needs no row here; the others have one in opcode_shapes.cpp.

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/bytecode/opcode.h"

namespace stepwright::native {

struct Shape {
  bytecode::Opcode opcode;
  std::string pops = {};    // stack types as letters, deepest first (opcode_list.h)
  std::string pushes = {};  // the same, of everything that lies there afterwards
  std::vector<std::uint32_t> operands = {};
  std::vector<std::uint64_t> constants = {};  // what constant operands name
  // Types of the function's locals behind those of the test, which LocalGet and LocalSet name from 0 on.
  std::string locals = {};
};

// Several where operand bytes matter. None for the opcodes that edge_control.h has functions for, and for one
// that nobody has thought of: a test sees to it that there is none.
std::vector<Shape> shapes_of(bytecode::Opcode opcode);

// "AddI32", "Index -3 4 8"
std::string name_of(const Shape& shape);

// Where the test's functions and their operands lie: the areas of the image, one behind the other.
namespace edge_layout {
inline constexpr std::uint32_t kInputs = 0;           // operands, eight bytes each; bytes from outside
inline constexpr std::uint32_t kOutputs = 64;         // results, eight bytes each
inline constexpr std::uint32_t kInstances = 128;      // of the test's functions
inline constexpr std::uint32_t kInstanceBytes = 160;  // operands, results, then a counter and BOOLs
inline constexpr std::uint32_t kCounter = 128;        // in the instance
inline constexpr std::uint32_t kBools = 136;          // in the instance: 0 1 0 1 ...
inline constexpr std::uint32_t kSecondInstance = kInstances + kInstanceBytes;
inline constexpr std::uint32_t kZeros = kSecondInstance + kInstanceBytes;  // eight bytes of zero, then -0.0
inline constexpr std::uint32_t kStrings = kZeros + 16;
inline constexpr std::uint32_t kStringsBytes = 7 * (4 + 32) + 7 * (4 + 16);  // WSTRINGs, then STRINGs
inline constexpr std::uint32_t kImageBytes = kStrings + kStringsBytes;
inline constexpr std::uint32_t kFrameBytes = 32;
inline constexpr std::uint32_t kMemoryBytes = kImageBytes + kFrameBytes;
}  // namespace edge_layout

}  // namespace stepwright::native

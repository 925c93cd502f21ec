#pragma once

// Variables by name: finds one in a program's symbols and reads it from a copy of the image. Host side.
//
//   result::Result<Variable> level = find_variable(program, "MAIN.tank[2].level");
//   Value value = read_value(*level, image);

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "runtime/bytecode/program.h"
#include "runtime/result/result.h"

namespace stepwright::loader {

// A variable of elementary type.
struct Variable {
  std::string name;  // the path as it was asked for
  bytecode::ElementaryType type = bytecode::ElementaryType::Bool;
  std::uint32_t address = 0;            // absolute
  std::uint8_t bit = bytecode::kNoBit;  // 0..7 for a located BOOL
};

// BOOL; signed integers and TIME (nanoseconds); unsigned integers and bit strings; REAL and LREAL.
using Value = std::variant<bool, std::int64_t, std::uint64_t, double>;

// Looks a path up, ignoring case: a symbol, or an element or member of one ("MAIN.fb.out", "a[2,3]").
// Fails with "B0300" if there is no such variable and "B0301" if it is not elementary.
[[nodiscard]] result::Result<Variable> find_variable(const bytecode::Program& program, std::string_view path);

// Requires the image of the variable's program. A REAL gives the double with the same shortest decimal form,
// so that 0.1 reads 0.1.
Value read_value(const Variable& variable, std::span<const std::byte> image);

}  // namespace stepwright::loader

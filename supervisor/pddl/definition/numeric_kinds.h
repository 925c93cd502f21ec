#pragma once

// Kinds of arithmetic, comparison and change: the words that schemas, ground actions and the ground task
// share.
//
// Thread rule: plain values.

#include <cstdint>

namespace stepwright::pddl {

enum class NumericKind : std::uint8_t { Constant, Fluent, Add, Subtract, Multiply, Divide, Negate };

enum class Relation : std::uint8_t { Less, LessEqual, Equal, GreaterEqual, Greater };

enum class ChangeKind : std::uint8_t { Add, Delete, Assign, Increase, Decrease, ScaleUp, ScaleDown };

}  // namespace stepwright::pddl

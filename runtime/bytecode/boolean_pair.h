#pragma once

// The instructions that mean two (LoadAndBoolAbs x y = LoadBoolAbs x, AndBoolAbs y), and which two.

#include <array>
#include <cassert>

#include "runtime/bytecode/instruction.h"

namespace stepwright::bytecode {

// The opcodes on absolute addresses; those on the instance have the next number.
struct BooleanPair {
  Opcode pair;
  Opcode first;
  Opcode second;
};

inline constexpr auto kBooleanPairs = std::to_array<BooleanPair>({
    {Opcode::LoadAndBoolAbs, Opcode::LoadBoolAbs, Opcode::AndBoolAbs},
    {Opcode::LoadOrBoolAbs, Opcode::LoadBoolAbs, Opcode::OrBoolAbs},
    {Opcode::LoadAndNotBoolAbs, Opcode::LoadBoolAbs, Opcode::AndNotBoolAbs},
    {Opcode::LoadOrNotBoolAbs, Opcode::LoadBoolAbs, Opcode::OrNotBoolAbs},
    {Opcode::LoadNorBoolAbs, Opcode::LoadNotBoolAbs, Opcode::AndNotBoolAbs},
    {Opcode::LoadNandBoolAbs, Opcode::LoadNotBoolAbs, Opcode::OrNotBoolAbs},
    {Opcode::AndStoreBoolAbs, Opcode::AndBoolAbs, Opcode::StoreBoolAbs},
    {Opcode::OrStoreBoolAbs, Opcode::OrBoolAbs, Opcode::StoreBoolAbs},
    {Opcode::AndNotStoreBoolAbs, Opcode::AndNotBoolAbs, Opcode::StoreBoolAbs},
    {Opcode::OrNotStoreBoolAbs, Opcode::OrNotBoolAbs, Opcode::StoreBoolAbs},
    {Opcode::MoveBoolAbs, Opcode::LoadBoolAbs, Opcode::StoreBoolAbs},
    {Opcode::MoveNotBoolAbs, Opcode::LoadNotBoolAbs, Opcode::StoreBoolAbs},
});

constexpr bool is_boolean_pair(Opcode opcode) {
  return opcode >= Opcode::LoadAndBoolAbs && opcode <= Opcode::MoveNotBoolThis;
}

// The form of an opcode on absolute addresses in another mode: 0 absolute, 1 on the instance.
constexpr Opcode in_mode(Opcode absolute, std::uint32_t mode) {
  return static_cast<Opcode>(static_cast<std::uint8_t>(absolute) + mode);
}

// The two instructions, in their order; `size` is that of the pair. Requires is_boolean_pair.
inline std::array<Instruction, 2> unfold(const Instruction& pair) {
  const auto number =
      static_cast<std::uint32_t>(pair.opcode) - static_cast<std::uint32_t>(kBooleanPairs[0].pair);
  const BooleanPair& means = kBooleanPairs[number / 2];
  assert(in_mode(means.pair, number % 2) == pair.opcode);
  return {Instruction{.opcode = in_mode(means.first, number % 2), .size = pair.size, .a = pair.a},
          Instruction{.opcode = in_mode(means.second, number % 2), .size = pair.size, .a = pair.b}};
}

}  // namespace stepwright::bytecode

#include "runtime/bytecode/writer/boolean_fusion.h"

#include "runtime/bytecode/boolean_pair.h"

#include <array>

namespace stepwright::writer {

using bytecode::in_mode;
using bytecode::Opcode;

namespace {

// The opcodes on absolute addresses; those on the instance have the next number.
struct Rule {
  Opcode first;
  Opcode second;
  Opcode fused;
};

constexpr auto kOperations = std::to_array<Rule>({
    {Opcode::LoadBoolAbs, Opcode::NotBool, Opcode::LoadNotBoolAbs},
    {Opcode::LoadNotBoolAbs, Opcode::NotBool, Opcode::LoadBoolAbs},
    {Opcode::LoadBoolAbs, Opcode::AndBool, Opcode::AndBoolAbs},
    {Opcode::LoadNotBoolAbs, Opcode::AndBool, Opcode::AndNotBoolAbs},
    {Opcode::LoadBoolAbs, Opcode::OrBool, Opcode::OrBoolAbs},
    {Opcode::LoadNotBoolAbs, Opcode::OrBool, Opcode::OrNotBoolAbs},
    {Opcode::LoadBoolAbs, Opcode::XorBool, Opcode::XorBoolAbs},
});

// Pairs that become one when their operands change places: NOT a AND b = b AND NOT a.
constexpr auto kSwapped = std::to_array<Rule>({
    {Opcode::LoadNotBoolAbs, Opcode::AndBoolAbs, Opcode::LoadAndNotBoolAbs},
    {Opcode::LoadNotBoolAbs, Opcode::OrBoolAbs, Opcode::LoadOrNotBoolAbs},
});

}  // namespace

std::optional<Opcode> fused_operation(Opcode load, Opcode operation) {
  for (const Rule& rule : kOperations) {
    for (const std::uint32_t mode : {0u, 1u}) {
      if (load == in_mode(rule.first, mode) && operation == rule.second) return in_mode(rule.fused, mode);
    }
  }
  return std::nullopt;
}

std::optional<FusedPair> fused_pair(Opcode first, Opcode second) {
  const auto fits = [&](Opcode x, Opcode y, std::uint32_t mode) {
    return first == in_mode(x, mode) && second == in_mode(y, mode);
  };
  for (const std::uint32_t mode : {0u, 1u}) {
    for (const bytecode::BooleanPair& each : bytecode::kBooleanPairs) {
      if (fits(each.first, each.second, mode)) return FusedPair{in_mode(each.pair, mode), false};
    }
    for (const Rule& rule : kSwapped) {
      if (fits(rule.first, rule.second, mode)) return FusedPair{in_mode(rule.fused, mode), true};
    }
  }
  return std::nullopt;
}

}  // namespace stepwright::writer

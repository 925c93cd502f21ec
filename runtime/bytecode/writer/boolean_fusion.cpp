#include "runtime/bytecode/writer/boolean_fusion.h"

#include <array>

namespace stepwright::writer {

using bytecode::Opcode;

namespace {

// The opcodes on absolute addresses; those on the instance have the next number.
struct Rule {
  Opcode first;
  Opcode second;
  Opcode fused;
  bool swapped = false;
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

constexpr auto kPairs = std::to_array<Rule>({
    {Opcode::LoadBoolAbs, Opcode::AndBoolAbs, Opcode::LoadAndBoolAbs},
    {Opcode::LoadBoolAbs, Opcode::OrBoolAbs, Opcode::LoadOrBoolAbs},
    {Opcode::LoadBoolAbs, Opcode::AndNotBoolAbs, Opcode::LoadAndNotBoolAbs},
    {Opcode::LoadBoolAbs, Opcode::OrNotBoolAbs, Opcode::LoadOrNotBoolAbs},
    {Opcode::LoadNotBoolAbs, Opcode::AndBoolAbs, Opcode::LoadAndNotBoolAbs, true},
    {Opcode::LoadNotBoolAbs, Opcode::OrBoolAbs, Opcode::LoadOrNotBoolAbs, true},
    {Opcode::LoadNotBoolAbs, Opcode::AndNotBoolAbs, Opcode::LoadNorBoolAbs},
    {Opcode::LoadNotBoolAbs, Opcode::OrNotBoolAbs, Opcode::LoadNandBoolAbs},
    {Opcode::AndBoolAbs, Opcode::StoreBoolAbs, Opcode::AndStoreBoolAbs},
    {Opcode::OrBoolAbs, Opcode::StoreBoolAbs, Opcode::OrStoreBoolAbs},
    {Opcode::AndNotBoolAbs, Opcode::StoreBoolAbs, Opcode::AndNotStoreBoolAbs},
    {Opcode::OrNotBoolAbs, Opcode::StoreBoolAbs, Opcode::OrNotStoreBoolAbs},
    {Opcode::LoadBoolAbs, Opcode::StoreBoolAbs, Opcode::MoveBoolAbs},
    {Opcode::LoadNotBoolAbs, Opcode::StoreBoolAbs, Opcode::MoveNotBoolAbs},
});

constexpr Opcode in_mode(Opcode absolute, int mode) {
  return static_cast<Opcode>(static_cast<int>(absolute) + mode);
}

}  // namespace

std::optional<Opcode> fused_operation(Opcode load, Opcode operation) {
  for (const Rule& rule : kOperations) {
    for (const int mode : {0, 1}) {
      if (load == in_mode(rule.first, mode) && operation == rule.second) return in_mode(rule.fused, mode);
    }
  }
  return std::nullopt;
}

std::optional<BooleanPair> fused_pair(Opcode first, Opcode second) {
  for (const Rule& rule : kPairs) {
    for (const int mode : {0, 1}) {
      if (first == in_mode(rule.first, mode) && second == in_mode(rule.second, mode)) {
        return BooleanPair{in_mode(rule.fused, mode), rule.swapped};
      }
    }
  }
  return std::nullopt;
}

}  // namespace stepwright::writer

#pragma once

// Fusion of two boolean instructions that follow each other into one: the peephole of FunctionBuilder. Pure
// functions; any thread.

#include <optional>

#include "runtime/bytecode/opcode.h"

namespace stepwright::writer {

// A load of a BOOL and the operation without operand behind it (LoadBoolAbs, AndBool -> AndBoolAbs).
std::optional<bytecode::Opcode> fused_operation(bytecode::Opcode load, bytecode::Opcode operation);

// A load and a fused operation, or either of them and a store; all on the same address mode.
struct FusedPair {
  bytecode::Opcode opcode;
  bool swapped = false;  // the second instruction's offset comes first
};
std::optional<FusedPair> fused_pair(bytecode::Opcode first, bytecode::Opcode second);

}  // namespace stepwright::writer

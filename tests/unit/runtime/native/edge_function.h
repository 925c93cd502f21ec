#pragma once

// Functions around one instruction: operands from places of every kind, results to places of every kind, so
// that the translator meets the instruction in every state that its operands can have.

#include <cstdint>
#include <vector>

#include "runtime/bytecode/writer/container_model.h"
#include "tests/unit/runtime/native/opcode_shapes.h"

namespace stepwright::native {

// Where an operand comes from.
enum class Source : std::uint8_t {
  Memory,    // a load that nothing has read yet: of the inputs (Abs) or of the instance (This)
  Local,     // of the function
  Computed,  // in a register of its own
  Flags,     // a comparison, for a Bool; as Computed for other types
  Constant,
};
inline constexpr std::uint8_t kSources = 5;

struct Surrounding {
  bool of_instance = false;  // operands and results in the instance, else in inputs and outputs
  bool in_loop = false;      // two turns, so that what lies at fixed places is kept in registers
  bool above = false;        // an operand below that reads a result's place, as it was before
  bool branch = false;       // a Bool on top decides a jump
};

// `sources` one for each operand; `values` what Constant gives.
writer::Function edge_function(const Shape& shape, const Surrounding& around,
                               const std::vector<Source>& sources, const std::vector<std::uint64_t>& values);

// The memory of all those functions; they have no tasks yet.
writer::ContainerModel edge_model();

}  // namespace stepwright::native

#pragma once

// Semantic model -> bytecode container.
//
// Boolean expressions are branch-free: AND, OR, XOR and NOT work on 0 and 1, both operands are always
// evaluated, there is no short-circuit (IEC 61131-3 leaves it open, 7.3.2). So the cost of a rung depends on
// the rung and not on its inputs, and a function call or an index in the right operand always happens.
// Integer arithmetic wraps to its type; REAL is single precision throughout.
//
// Pure; equal models give equal bytes.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ladder/semantics/model/model.h"
#include "ladder/source/source_set.h"
#include "runtime/ground/result/result.h"

namespace stepwright::codegen {

struct ChartStep {
  std::string name;
  std::string comment;
  bool initial = false;
  std::string variable;  // BOOL variable of the POU: the step is active
};

struct ChartTransition {
  std::string name;
  std::string condition;               // as ST, for people
  std::vector<std::uint32_t> sources;  // indexes of steps
  std::vector<std::uint32_t> targets;
  std::string variable;  // BOOL variable of the POU: the transition fires; may be empty
};

// The chart that a POU was lowered from, for viewers.
struct ChartOrigin {
  const semantics::Pou* pou = nullptr;
  std::vector<ChartStep> steps;
  std::vector<ChartTransition> transitions;
};

// Requires a model without errors. `file_names`: how the container calls each file of `sources`. Fails where
// the program is larger than a container may be (E0109, E0209, at the place), and with B0100 if the writer's
// verifier rejects the result for another reason, which is a mistake of the compiler.
[[nodiscard]] result::Result<std::vector<std::byte>> generate(const semantics::Model& model,
                                                              const std::vector<ChartOrigin>& charts,
                                                              const source::SourceSet& sources,
                                                              const std::vector<std::string>& file_names);

}  // namespace stepwright::codegen

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
#include <string>
#include <vector>

#include "ladder/graphic/sfc_chart.h"
#include "ladder/semantics/model.h"
#include "ladder/source/source_set.h"
#include "runtime/result/result.h"

namespace stepwright::codegen {

// The chart that a POU was lowered from, for viewers: its steps and transitions are BOOL variables of the
// POU.
struct ChartOrigin {
  const semantics::Pou* pou = nullptr;
  graphic::SfcChart chart;
  std::vector<std::string> step_variables;        // in the order of chart.steps
  std::vector<std::string> transition_variables;  // in the order of chart.transitions; may be empty
};

// Requires a model without errors. Fails (B0100) only if the writer's verifier rejects the result.
[[nodiscard]] result::Result<std::vector<std::byte>> generate(const semantics::Model& model,
                                                              const std::vector<ChartOrigin>& charts,
                                                              const source::SourceSet& sources);

}  // namespace stepwright::codegen

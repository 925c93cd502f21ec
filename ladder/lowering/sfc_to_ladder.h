#pragma once

// Lowers a sequential function chart to a ladder diagram with step bits, transition bits and set/reset coils,
// in the manner of Figure 14 of paper 6 (planning on the PLC bench). There is no SFC engine at run time: the
// meaning of a chart is the meaning of its rungs. ladder/doc/sfc_semantics.md is the specification.
// Pure functions; use from any thread.
//
// Invariants of the result: every transition is evaluated on the step bits at the start of the scan, and what
// its condition calls or computes only while it is enabled; one evolution per scan; all generated names are
// legal, unique in the POU and listed in its variables.
//
//   Result<graphic::Pou> ladder = lower_sfc(pou);            // pou.body holds an SfcChart
//   std::get<graphic::LadderProgram>(ladder->body).rungs     // what the compiler takes
//   ladder->step_variables[i]                                // BOOL variable of chart.steps[i]: "LOAD_X"

#include <vector>

#include "ladder/graphic/project.h"
#include "ladder/lowering/condition_network.h"
#include "runtime/ground/result/result.h"

namespace stepwright::lowering {

// Generated variables of step S: `S_X` (active), `S_T` (elapsed time, only if some text uses `S.T`); of
// transition T: `T_FIRES` (`TRANS<i>_FIRES` if it has no name); of action A with a body: `A_Q`, `A_A` where
// its flags are needed; the rest is listed in sfc_semantics.md.
// `<step>.X` and `.T`, `<action>.Q` and `.A` in conditions, durations and action bodies become these
// variables. Requires a body that holds a chart. Fails with the errors of graphic::check, with E0721 if a
// step or an action has the name of a variable, E0722 if an action block's target is not BOOL, E0724 if an
// action's body holds RETURN, E0726 if it writes a flag.
[[nodiscard]] result::Result<graphic::Pou> lower_sfc(const graphic::Pou& pou);

// The same where every name of the POU is in its variables or in `globals`: a target of an action block that
// is neither a variable nor an action is E0723, an indicator that is not declared E0725.
[[nodiscard]] result::Result<graphic::Pou> lower_sfc(const graphic::Pou& pou,
                                                     const std::vector<graphic::Variable>& globals);

// The same with networks that were drawn beside the chart or as its conditions: they may read the flags of
// steps and actions too.
[[nodiscard]] result::Result<graphic::Pou> lower_sfc_beside(const graphic::Pou& pou, ChartNetworks networks);

// Every POU that holds a chart lowered, the others unchanged; all or nothing.
[[nodiscard]] result::Result<graphic::Project> lower_sfc(const graphic::Project& project);

}  // namespace stepwright::lowering

#pragma once

// The binding of a planned cell against its domain and its plant, before anything runs
// (supervisor/doc/binding_file.md has the codes).
//
// - B0010: an action drives no output, and does not say so
// - B0011: a terminal that the plant does not have
// - B0012: no sensor shows what actions change and others need
// - B0013: a unit or a calibration that does not match
// - B0014: a completion that can never be
// - B0015: a timeout that is too short for the plant
// - B0016: two sensors that read one tag
//
// Pure but for the files of the cell; any thread.

#include "cell/config/cell_config.h"
#include "runtime/ground/result/diagnostic.h"
#include "supervisor/pddl/task/task.h"
#include "supervisor/translate/binding.h"

namespace stepwright::cell_binding {

// Everything of these, at its place in the binding; nothing for a cell without [planning], or whose planning
// files cannot be read, which whoever opens them says.
result::Diagnostics check_binding(const config::CellConfig& config);

// The parts: actions against the domain, and terminals against the plant. Where the plant is not simulated or
// described nothing is known of its terminals.
result::Diagnostics check_actions(const pddl::Task& task, const translate::Binding& binding);
result::Diagnostics check_terminals(const config::CellConfig& config, const translate::Binding& binding);

}  // namespace stepwright::cell_binding

#pragma once

// The files of a cell that is made of a PLCopen project: the template of programs/new/templates/plcopen,
// filled in with what the project has. Pure; any thread.

#include <string>
#include <utility>
#include <vector>

#include "programs/new/plcopen_project.h"

namespace stepwright::new_cell {

// Pairs of a placeholder's name and what stands there: "{{outputs}}" is "outputs".
using Fillings = std::vector<std::pair<std::string, std::string>>;

// What the templates need but for {{left}}. A device that no cell takes as the editor has it is left out, and
// a line of TakenProject::left.
Fillings fillings_of(TakenProject& project);

// {{left}}: what was not taken, and why the cell does not run.
std::string left_of(const TakenProject& project);

}  // namespace stepwright::new_cell

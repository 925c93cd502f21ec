#pragma once

// The files of a cell that is made of a PLCopen project: what the project has, for the placeholders of a
// template (programs/new/templates/plcopen). Pure; any thread.

#include <string>
#include <utility>
#include <vector>

#include "cell/import/plcopen_project.h"

namespace stepwright::cell_import {

// Pairs of a placeholder's name and what stands there: "{{outputs}}" is "outputs".
using Fillings = std::vector<std::pair<std::string, std::string>>;

// What the templates need but for {{left}}. A device that no cell takes as the editor has it is left out, and
// a line of TakenProject::left.
Fillings fillings_of(TakenProject& project);

// {{left}}: what was not taken, and why the cell does not run.
std::string left_of(const TakenProject& project);

}  // namespace stepwright::cell_import

#pragma once

// Declarations of a graphic project as ST: one parser reads them all. Internal to this folder.

#include <string>

#include "ladder/graphic/project.h"

namespace stepwright::driver {

// "VAR_INPUT x AT %IX0.0 : BOOL := TRUE; END_VAR", on one line.
std::string declaration_text(const graphic::Variable& variable);

// Globals, tasks and instances; empty if the project has none of them.
std::string configuration_text(const graphic::Project& project);

}  // namespace stepwright::driver

#pragma once

// Declarations of a graphic project as ST: one parser reads them all. Internal to this folder.

#include <cstdint>
#include <functional>
#include <string>

#include "ladder/graphic/project.h"

namespace stepwright::driver {

// "VAR_INPUT x AT %IX0.0 : BOOL := TRUE; END_VAR", on one line.
std::string declaration_text(const graphic::Variable& variable);

// The mark of where something stands in the project's file.
using Mark = std::function<std::string(std::uint32_t where)>;

// TYPE .. END_TYPE; empty if the project has no types.
std::string types_text(const graphic::Project& project, const Mark& mark);

// Globals, tasks and instances; empty if the project has none of them.
std::string configuration_text(const graphic::Project& project, const Mark& mark);

}  // namespace stepwright::driver

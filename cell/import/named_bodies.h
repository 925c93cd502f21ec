#pragma once

// Actions and transitions of a POU that have names: a chart takes those that its steps and transitions name;
// of any other body nothing does. Pure; any thread.

#include <string>
#include <vector>

#include "ladder/graphic/project.h"

namespace stepwright::cell_import {

// Whether the body is a chart.
bool takes_named_bodies(const graphic::DrawnBody& drawn);

// A line for each that nothing takes.
void tell_named_bodies(const graphic::Project& project, std::vector<std::string>& left);

}  // namespace stepwright::cell_import

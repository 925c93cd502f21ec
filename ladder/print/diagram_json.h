#pragma once

// Networks of function blocks as they were drawn, for a program document (program_document.h). Internal to
// this folder.

#include <nlohmann/json.hpp>

#include "ladder/graphic/diagram.h"

namespace stepwright::print {

// One block of kind "diagram". Elements name those that their inputs come from by their place in the list.
nlohmann::ordered_json diagram_json(const graphic::Diagram& diagram);

}  // namespace stepwright::print

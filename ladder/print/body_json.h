#pragma once

// The body of a sheet as the blocks of a program document (program_document.h). Internal to this folder.

#include <nlohmann/json.hpp>

#include "ladder/graphic/sheet.h"

namespace stepwright::print {

// "ST", "LD", "FBD", "SFC".
const char* language_of(const graphic::Sheet& sheet);

// The blocks that BodyUse::block counts.
nlohmann::ordered_json blocks_json(const graphic::Sheet& sheet);

}  // namespace stepwright::print

#pragma once

// Small questions that both prints ask about a sheet. Internal to this folder; pure functions.

#include <string>

#include "ladder/graphic/sheet.h"

namespace stepwright::print {

// "FUNCTION limit : INT"
std::string title_of(const graphic::Sheet& sheet);
// Sheets with code; types and configurations have none.
bool has_references(const graphic::Sheet& sheet);
// The body of an action, numbered from 1.
graphic::Listing listing_of(const graphic::Action& action);

}  // namespace stepwright::print

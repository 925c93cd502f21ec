#pragma once

// Constraints, suggestions and causes in words. Pure functions; any thread.

#include <span>
#include <string>

#include "supervisor/tamp/intervals/cause/cause.h"

namespace stepwright::tamp {

// "the region tray1 at a height of 0.3850 m".
std::string text_of(const WorkCell& cell, std::span<const Action> sequence, const Suggestion& suggestion);
// The sentence of a cause whose set and suggestions are there.
std::string sentence_of(const WorkCell& cell, std::span<const Action> sequence, const Cause& cause);

}  // namespace stepwright::tamp

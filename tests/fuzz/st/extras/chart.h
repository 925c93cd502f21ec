#pragma once

// Random safe charts as the body of a function block: sequences, selections and simultaneous branches that
// nest, jumps back to the start, conditions on variables, steps and step times, actions of every qualifier.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

// Steps and transitions; the names of the actions that statements are wanted for are appended.
std::string random_chart(Material& material, std::vector<std::string>& actions);

}  // namespace stepwright::st_fuzz

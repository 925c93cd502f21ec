#pragma once

// The timers of a formula as statements. Private to this library. Thread rule: pure functions.

#include <string>
#include <vector>

#include "supervisor/ltl/syntax/syntax_tree.h"

namespace stepwright::ltl {

// `name` is the variable of the timer's proposition, `names` are those of all.
std::string timer_declarations(const Timed& timed, const std::string& name);
std::string timer_step(const SyntaxTree& tree, const Timed& timed, const std::vector<std::string>& names);
std::string timer_reset(const Timed& timed, const std::string& name);

}  // namespace stepwright::ltl

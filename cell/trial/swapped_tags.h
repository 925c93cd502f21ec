#pragma once

// Two tags of a binding that look swapped: with each in the other's place the plant begins where the problem
// says. Pure.

#include <string>

#include "cell/trial/action_run.h"

namespace stepwright::trial {

// The lines to write instead, for the hint of a run that has not begun; empty: no two tags explain it.
std::string swapped_tags(const translate::Binding& binding, const ActionRun& run);

}  // namespace stepwright::trial

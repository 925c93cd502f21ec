#pragma once

// The logic of support::many_rungs as a ladder project, and as C++ for the baseline.

#include <string>

#include "ladder/graphic/project.h"

namespace stepwright::bench {

// Rung i: m[i] := (m[i-1] OR input) AND NOT m[i-2], three contacts and a coil.
graphic::Project rungs_as_ladder(int count);
// Branch-free, as the compiler's own code is.
std::string rungs_as_cpp(int count);

}  // namespace stepwright::bench

#pragma once

// Random charts for property tests: any structure that `check` lets pass, also unsafe and unbalanced ones.

#include <random>

#include "ladder/graphic/project.h"

namespace stepwright::lowering {

// BOOL inputs i0..i3 and INT inputs n0, n1 are declared; outputs o0..o3 with any qualifiers, counters c0, c1
// that the actions COUNT0, COUNT1 increment once a scan while they run.
graphic::Pou random_pou(std::mt19937& random);

}  // namespace stepwright::lowering

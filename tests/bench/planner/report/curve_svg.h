#pragma once

// The scaling curve of one domain as a picture: time and memory over size, our planner, its grounding and the
// baseline.
//
// Thread rule: pure function.

#include <string>

#include "tests/bench/planner/scale.h"

namespace stepwright::bench {

// A whole SVG document, readable without colour. Both axes are logarithmic.
std::string to_svg(const Curve& curve);

}  // namespace stepwright::bench

#pragma once

// Both distributions of a measurement as one picture: latency over the share of wake-ups that are later.

#include <string>

#include "runtime/scan_test/measurement.h"

namespace stepwright::scan_test {

// A whole SVG document, readable without colour.
std::string to_svg(const Measurement& measured);

}  // namespace stepwright::scan_test

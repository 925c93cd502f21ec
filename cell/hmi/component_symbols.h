#pragma once

// Small symbols of components for the drawing of a described plant, in the manner of ISA-101 and ISO 14617:
// outlines without colour, which say what a box is before its name is read.
//
// A pure function; any thread.

#include <string>
#include <string_view>

namespace stepwright::hmi {

inline constexpr double kSymbolSize = 18.0;

// An SVG fragment of that size at (x, y); empty for a type without a symbol.
std::string component_symbol(std::string_view type, double x, double y);

}  // namespace stepwright::hmi

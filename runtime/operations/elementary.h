#pragma once

// The elementary functions of IEC 61131-3 (table 28): in double, with the platform's C library. A result may
// differ in its last bit between two libraries; both engines of one machine use the same one.

#include <cstdint>

namespace stepwright::operations {

enum class Elementary : std::uint8_t { Sin, Cos, Tan, Asin, Acos, Atan, Exp, Ln, Log };

// False, and `result` unchanged, outside the function's domain: Ln and Log of x <= 0, Asin and Acos beyond
// -1..1. Infinities and NaN are as IEEE 754 has them.
bool elementary(Elementary function, double x, double& result);

// The angle of the point (x, y), in radians.
double arc_tangent(double y, double x);

// x to the power of y. False, and `result` unchanged, for 0 to a negative power and for a negative number to
// a power that is no integer.
bool power(double x, double y, double& result);

}  // namespace stepwright::operations

#pragma once

// Numbers as literals of IEC 61131-3 (6.3.2: a real number has a point, and a digit on both sides of it).
// Pure functions; use from any thread.
//
//   real_literal(1.25)         ->  "1.25"        (the shortest that reads as the same number)
//   real_literal(1.0 / 3, 7)   ->  "0.3333333"
//   real_literal(1e-5)         ->  "1.0e-05"

#include <string>

namespace stepwright::graphic {

// Requires a finite number. Zero has no sign.
std::string real_literal(double value);
// Rounded to so many digits, from 1 to 17.
std::string real_literal(double value, int digits);

}  // namespace stepwright::graphic

#pragma once

// Numbers and times as literals of Structured Text. Pure functions; any thread.
//
//   real_literal(1.25);                            // "1.25"
//   time_literal(std::chrono::milliseconds(250));  // "T#250ms"

#include <chrono>
#include <string>

namespace stepwright::vehicle {

// "1.25", "1.0e-05": a REAL, to its seven digits.
std::string real_literal(double value);
// "T#90s", "T#250ms"
std::string time_literal(std::chrono::milliseconds time);
// "Name := 1.25", a member of a structure's first value.
std::string member(const char* name, double value);

}  // namespace stepwright::vehicle

#pragma once

// A library as large as one wants: functions and function blocks of 20 to 60 lines with structures, arrays,
// enumerations, loops and calls among each other, and a program that uses them all. What its
// functions give is known, because the same is computed here in C++.
//
//   const support::PouLibrary library = support::pou_library(500);
//   compile({{"library.st", library.text}});  after one scan main.sum is library.sum

#include <cstdint>
#include <string>

namespace stepwright::support {

struct PouLibrary {
  std::string text;
  std::int32_t sum = 0;    // main.sum after the first scan: of the functions
  std::int32_t ticks = 0;  // main.ticks after the first scan: of the function blocks
};

// `count` POUs, every second one a function block. Equal counts give equal texts.
PouLibrary pou_library(int count);

}  // namespace stepwright::support

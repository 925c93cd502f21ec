#pragma once

// Codes of the cell's refusals by which the page's server decides what to do next. What else is refused is
// passed on to whoever asked. Pure; any thread.

#include <string>

#include "runtime/result/diagnostic.h"

namespace stepwright::api {

inline constexpr const char* kNobodyAnswers = "D0001";
inline constexpr const char* kProgramJustChanged = "D0002";
inline constexpr const char* kLinkOfAnotherVersion = "D0008";
inline constexpr const char* kAnotherProgram = "R0009";  // than the request was meant for

// It may have happened or not.
inline bool nobody_answers(const result::Diagnostics& problems) {
  return !problems.empty() && problems.front().code == kNobodyAnswers;
}

// True for problems that may pass: the request can be repeated.
inline bool is_asked_again(const result::Diagnostics& problems) {
  if (problems.empty()) return false;
  const std::string& code = problems.front().code;
  return code == kNobodyAnswers || code == kProgramJustChanged || code == kLinkOfAnotherVersion ||
         code == kAnotherProgram;
}

}  // namespace stepwright::api

#pragma once

// Refusals of the cell by which the page's server decides what to do next. All others are passed on to
// whoever asked. Pure; any thread.

#include <string>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/service/answer_codes.h"

namespace stepwright::api {

using service::kNobodyAnswers;
using service::kProgramJustChanged;

inline bool nobody_answers(const result::Diagnostics& problems) {
  return !problems.empty() && problems.front().code == kNobodyAnswers;
}

inline bool link_is_of_another_version(const result::Diagnostics& problems) {
  return !problems.empty() && problems.front().code == service::kOtherVersion;
}

// Nobody answers that is understood, or another program has just come: to be asked again.
inline bool is_asked_again(const result::Diagnostics& problems) {
  if (problems.empty()) return false;
  const std::string& code = problems.front().code;
  return nobody_answers(problems) || link_is_of_another_version(problems) || code == kProgramJustChanged ||
         code == service::kOtherProgram;
}

}  // namespace stepwright::api

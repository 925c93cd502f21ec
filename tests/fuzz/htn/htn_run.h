#pragma once

// A text through reader, search and validator: refused with a place, or planned alike by both.

#include <string>
#include <string_view>

namespace stepwright::fuzz::htn {

struct Run {
  bool parsed = false;
  bool planned = false;
  std::string finding;  // empty: nothing is wrong
};

// A domain, and behind a line ";;problem" a problem.
Run run(std::string_view input);

}  // namespace stepwright::fuzz::htn

#pragma once

// One input through the whole front end: parser, checker, printing and reading back, grounding, a short walk
// beside the executor, plan reader and validator.
//
// The input is a domain, a line ";;problem", a problem, and maybe a line ";;plan" and a plan.

#include <string>
#include <string_view>

namespace stepwright::fuzz::pddl {

struct Run {
  bool parsed = false;    // domain and problem are a task
  bool grounded = false;  // small enough to be grounded, and it was
  std::size_t diagnostics = 0;
  std::string finding;  // what is wrong with us; empty = nothing
};

Run run(std::string_view input);

}  // namespace stepwright::fuzz::pddl

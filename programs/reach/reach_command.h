#pragma once

// `stepwright reach SEQUENCE.toml [--json FILE] [--svg FILE] [--st FILE]`: the ranges that are left to a
// sequence of actions, or why it cannot be done.

#include <string>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::reach_program {

struct ReachArguments {
  std::string sequence;
  std::string json_file;  // empty: none
  std::string svg_file;   // empty: none
  std::string st_file;    // empty: none
};

// NoPlan: refuted. BudgetExhausted: neither refuted nor a solution of the constraints found.
result::ExitCode run_reach(const ReachArguments& arguments);

}  // namespace stepwright::reach_program

#pragma once

// `stepwright ltl PROBLEM.json [--json FILE] [--svg FILE] [--seed N] [--time S] [--shorten S] [--threads N]`.

#include <cstddef>
#include <cstdint>
#include <string>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::ltl_program {

struct PlanArguments {
  std::string problem;
  std::string json_file;  // empty: none
  std::string svg_file;   // empty: none
  std::uint64_t seed = 1;
  double time_s = 10.0;  // until the first plan
  double shorten_s = 1.0;
  std::size_t threads = 0;  // 0: as many as the machine has, at most 2
};

// NoPlan: even a point cannot do the task. BudgetExhausted: no plan was found in that time.
result::ExitCode run_plan(const PlanArguments& arguments);

}  // namespace stepwright::ltl_program

#pragma once

// `stepwright plan DOMAIN PROBLEM [--optimal | --first] [--time S] [--json FILE] [--out PLAN]
// [--svg FILE [--binding B]] [--threads N] [--progress]`.

#include <optional>
#include <string>

#include "programs/plan/plan_picture.h"
#include "runtime/ground/result/exit_code.h"

namespace stepwright::plan {

struct PlanArguments {
  std::string domain;
  std::string problem;
  bool optimal = false;
  bool first = false;            // end with the first plan
  std::optional<double> time_s;  // default: 10 s; none with --optimal
  std::size_t memory_mb = 0;     // 0: the planner's default
  unsigned threads = 2;          // 1: the same plan every time
  bool progress = false;         // also where stderr is no terminal
  std::string json_file;         // empty: none
  std::string out_file;          // empty: none
  PictureArguments picture;
};

// Done with a plan, proved optimal or not; NoPlan if it is proved that there is none.
result::ExitCode run_plan(const PlanArguments& arguments);

}  // namespace stepwright::plan

#pragma once

// `stepwright htn DOMAIN.hddl PROBLEM.hddl [--json FILE] [--out PLAN] [--time S] [--external NAME]`.

#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::htn_program {

struct HtnArguments {
  std::string domain;
  std::string problem;
  double time_s = 10.0;
  std::vector<std::string> external;  // predicates that are taken to hold
  std::string json_file;              // empty: none
  std::string out_file;               // empty: none
};

// Done with a plan that the validator accepts; NoPlan if it is proved that there is none.
result::ExitCode run_htn(const HtnArguments& arguments);

}  // namespace stepwright::htn_program

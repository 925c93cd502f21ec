#pragma once

// `stepwright validate DOMAIN PROBLEM PLAN [--json FILE]`.

#include <string>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::plan {

struct ValidateArguments {
  std::string domain;
  std::string problem;
  std::string plan;
  std::string json_file;  // empty: none
  bool quiet = false;     // no table
};

// BadInput if a file is malformed or the plan is not valid.
result::ExitCode run_validate(const ValidateArguments& arguments);

}  // namespace stepwright::plan

#pragma once

// `stepwright ltl check FORMULA TRACE.csv [--let NAME=COLUMN>VALUE ...] [--decided] [--json FILE]`.

#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::ltl_program {

struct CheckArguments {
  std::string formula;
  std::string trace;
  std::vector<std::string> bindings;
  bool decided = false;   // UNDECIDED is not good enough
  std::string json_file;  // empty: none
};

// Done: TRUE or UNDECIDED. RuntimeFault: FALSE, and UNDECIDED where a decision is asked for.
result::ExitCode run_check(const CheckArguments& arguments);

}  // namespace stepwright::ltl_program

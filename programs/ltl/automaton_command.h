#pragma once

// `stepwright ltl automaton FORMULA [--to hoa|svg|st] [--part good|bad] [-o FILE]`.

#include <optional>
#include <string>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/ltl/hoa/hoa.h"

namespace stepwright::ltl_program {

struct AutomatonArguments {
  std::string formula;
  std::string to = "hoa";
  std::optional<ltl::HoaPart> part;  // of HOA; nothing: what the formula's class says
  std::string out_file;              // empty: standard output
};

result::ExitCode run_automaton(const AutomatonArguments& arguments);

}  // namespace stepwright::ltl_program

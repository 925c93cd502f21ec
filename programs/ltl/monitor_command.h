#pragma once

// `stepwright ltl monitor FORMULA -o FILE.st [--name FB_NAME] [--form table|branches]`.

#include <string>

#include "programs/ltl/formula_input.h"
#include "supervisor/ltl/monitor/monitor_block.h"

namespace stepwright::ltl_program {

struct MonitorArguments {
  std::string formula;
  std::string out_file;  // empty: standard output
  std::string name = "LTL_MONITOR";
  ltl::BlockForm form = ltl::BlockForm::Automatic;
};

// The block with legal names for its inputs: those of the propositions as far as they are.
[[nodiscard]] result::Result<std::string> block_text(const Watched& watched,
                                                     const MonitorArguments& arguments);

result::ExitCode run_monitor(const MonitorArguments& arguments);

}  // namespace stepwright::ltl_program

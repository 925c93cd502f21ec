#pragma once

// `stepwright tamp PROBLEM.toml [--json FILE] [--svg FILE] [--seed N] [--time S] [--method
// ours|paper-literal]`.

#include <cstddef>
#include <cstdint>
#include <string>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::tamp_program {

struct TampArguments {
  std::string problem;
  std::string json_file;  // empty: none
  std::string svg_file;   // empty: none
  std::uint64_t seed = 1;
  double time_s = 60.0;
  std::string method = "ours";
  std::size_t grasps = 0, places = 0;  // 0: the file's
};

// Done with a plan that the judge accepts; NoPlan if it is proved that there is none.
result::ExitCode run_tamp(const TampArguments& arguments);

}  // namespace stepwright::tamp_program

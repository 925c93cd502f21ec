#pragma once

// `stepwright fleet PROBLEM.json [--json FILE] [--svg FILE] [--paper] [--time S] ...`.

#include <optional>
#include <string>

#include "runtime/result/exit_code.h"
#include "supervisor/fleet/schedule/problem.h"

namespace stepwright::fleet {

struct FleetArguments {
  std::string problem;
  bool paper = false;
  Objective objective = Objective::Makespan;
  double time_s = 10.0;
  std::optional<double> path_time_s;  // nothing: A*
  double path_factor = 1.0;
  unsigned alternatives = 48;
  unsigned threads = 2;
  std::optional<std::string> cache_folder;
  bool progress = false;  // also where stderr is no terminal
  std::string json_file;  // empty: none
  std::string svg_file;   // empty: none
};

result::ExitCode run_fleet(const FleetArguments& arguments);

}  // namespace stepwright::fleet

#pragma once

// `stepwright fleet PROBLEM.json [--json FILE] [--svg FILE] [--program FILE.swb [--config CELL.toml]] ...`.

#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
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
  unsigned give_way = 0;
  unsigned threads = 2;
  std::optional<std::string> cache_folder;
  bool progress = false;     // also where stderr is no terminal
  std::string json_file;     // empty: none
  std::string svg_file;      // empty: none
  std::string program_file;  // the plan as a program; empty: none
  std::string config;        // of the cell whose terminals and interval it has; empty: terminals in a row
  std::vector<std::string> overrides;  // KEY=VALUE that win over it
};

result::ExitCode run_fleet(const FleetArguments& arguments);

}  // namespace stepwright::fleet

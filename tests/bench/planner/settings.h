#pragma once

// Settings from the command line.
//
// Thread rule: a plain value.

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/planner/measure/measurement.h"

namespace stepwright::bench {

struct Settings {
  Limits limits;                     // per instance and planner
  std::vector<std::string> domains;  // empty: all
  int sizes = 0;                     // only the first so many sizes of each domain; 0: all
  std::uint64_t seed = 1;
  std::string json_file;
  std::string write_folder;  // the instances as files
  std::string best_file;     // the best known costs
  bool update_best = false;
  bool baseline = true;
  std::vector<Outside> outside;
  std::chrono::milliseconds outside_time{30000};  // for each of them
  bool scale = false;                             // scaling curves instead of the table
  std::string svg_folder;                         // where their pictures go
  int repeats = 9;                                // of the tank bench's own measurements
};

// Nothing after --help or a wrong option, with the exit code in `exit_code`.
std::optional<Settings> settings_from(int argc, char** argv, int& exit_code);

}  // namespace stepwright::bench

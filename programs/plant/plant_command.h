#pragma once

// `stepwright plant FILE`: checks a plant that is described by components, lists its terminals, values and
// faults, says how fast it runs, and notes how it answers without a controller.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"

namespace stepwright::plant_program {

struct PlantArguments {
  std::string file;
  bool types = false;
  std::optional<double> seconds;  // given: it runs
  double interval_s = 0.01;
  std::vector<std::string> sets;
  std::vector<std::string> faults;
  std::vector<std::string> values;
  std::uint64_t seed = 1;
  std::string csv_file;   // empty: none
  std::string svg_file;   // empty: none
  std::string json_file;  // empty: none
};

result::ExitCode run_plant(const PlantArguments& arguments);

}  // namespace stepwright::plant_program

#pragma once

// [plant] of a model that runs in a process of its own, in lock-step with the scan: kind "shared" (a program
// in any language, plant_models/doc/shared_plant.md), "fmu" and "st".
//
//   [plant]
//   kind = "shared"
//   command = ["python3", "tank.py"]    # "fmu": file = "tank.fmu"; "st": sources = ["tank.st"]
//   step_us = 10_000                    # of simulated time in one step; default: [clock] interval_us
//   timeout_ms = 1_000                  # for the answer to a step; then the plant is lost
//   start_timeout_ms = 30_000           # until it is ready
//   [plant.sensors]                     # what the plant says and the program reads
//   full = "%IX4.0"                     # a switch: true where the number is not 0
//   level = { address = "%IW0", unit = "m", range = [0.0, 2.0], counts = [0, 27_648] }
//   [plant.actuators]                   # what the program says; likewise
//   valve = "%QX0.0"
//   [plant.values]                      # what reports and the page know beside the sensors, with its unit
//   volume = "l"
//   [plant.faults]                      # that the plant can have, with the unit of their value; 0: it has
//   not leak = { unit = "l/s", range = [0.0, 0.5] }   # what of it happens, for campaigns; or the unit alone
//   [plant.parameters]                  # "fmu" and "st": values of variables at the start
//   area = 0.5
//
// Thread-safe: pure.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

struct SteppedTerminalConfig {
  std::string name;
  std::string address;
  bool is_switch = false;  // of one bit
  double at_zero = 0.0;    // the quantity at 0 counts
  double per_count = 1.0;
  std::string unit = {};
  std::string meaning = {};
  result::Location where = {};
};

struct SteppedQuantityConfig {
  std::string name;
  std::string unit;
  result::Location where = {};
  double low = 0.0;  // of a fault: what of it happens; the same: nothing is known
  double high = 0.0;
};

struct SteppedParameterConfig {
  std::string name;
  double value = 0.0;
  result::Location where = {};
};

struct SteppedPlantConfig {
  std::vector<std::string> command;            // "shared"
  std::filesystem::path file;                  // "fmu"
  std::vector<std::filesystem::path> sources;  // "st"
  std::filesystem::path folder;                // of the cell
  std::chrono::microseconds step{10'000};
  std::chrono::milliseconds patience{1'000};
  std::chrono::milliseconds beginning{30'000};
  std::vector<SteppedTerminalConfig> sensors;
  std::vector<SteppedTerminalConfig> actuators;
  std::vector<SteppedQuantityConfig> values;
  std::vector<SteppedQuantityConfig> faults;
  std::vector<SteppedParameterConfig> parameters;
  result::Location where;  // of what says which model it is
};

// True for the kinds above.
bool is_stepped(const std::string& kind);

// Errors are reported to the document of `plant`. Relative paths are taken from `folder`.
SteppedPlantConfig read_stepped_plant(const settings::TomlTable& plant, const std::string& kind,
                                      const std::filesystem::path& folder, std::int64_t interval_us);

}  // namespace stepwright::config

#pragma once

// An FMU as a plant that is stepped: what the process does that is started for [plant] kind = "fmu". It holds
// the library of somebody else, so that process is all that its crash costs.
//
//   auto peer = stepped::StepPeer::open();
//   return run_fmu(*peer, {.file = "tank.fmu", .folder = "state/fmu"});
//
// Threads: one.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "plant_models/stepped/step_peer.h"

namespace stepwright::fmu {

struct FmuOptions {
  std::filesystem::path file;
  std::filesystem::path folder;  // where it is unpacked; emptied before
  std::vector<std::pair<std::string, double>> parameters = {};
};

// Until the runtime ends or the FMU fails; the exit code. What is wrong with the FMU goes to the runtime.
int run_fmu(stepped::StepPeer& peer, const FmuOptions& options);

}  // namespace stepwright::fmu

#pragma once

// One run of a campaign: a fresh cell in simulated time, in its own state folder, disturbed, and judged by
// the plant's truth. With a planner the cell's mission runs to its end; without one its program runs for a
// given time.
//
//   CampaignCell cell{"cells/bench/cell.toml"};
//   auto base = prepare(cell);                                    // what is wrong with the cell
//   CellRun run = run_cell(*base, 7, draw(7, base->offered, 120.0));
//
// A run is lost if it ends otherwise than at its goal or in its safe state, if its plant is lost, if the
// plant is not where the report says, or if it gives up before anything was wrong; it is violated if a
// monitor of the cell fails, or if the plant itself saw what must not be.
//
// Threads: any number of runs at once.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cell/campaign/disturbance.h"
#include "cell/campaign/verdict.h"
#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"

namespace stepwright::campaign {

struct CampaignCell {
  std::filesystem::path file;
  std::vector<std::string> overrides = {};  // KEY=VALUE
  std::filesystem::path states;             // a folder of each run's state is made here and removed
  double seconds = 60.0;                    // of a run without a planner
};

struct CellBase {
  CampaignCell cell;
  std::vector<std::string> overrides;  // the cell's, and those of a campaign
  std::vector<OfferedFault> offered;
  std::size_t without_range = 0;  // faults that the plant has and offers no values of
  bool planned = false;
  std::vector<std::byte> program{};  // without a planner
};

struct CellRun {
  std::uint64_t seed = 0;
  Disturbance disturbance;
  Verdict verdict = Verdict::Lost;
  std::string cause;                 // why it stopped, in a word: "leak", "monitor limit", "plant lost"
  std::string why;                   // a sentence; of a goal that was reached: empty
  std::string printed;               // last by the plant's processes, of a plant that is lost
  std::vector<std::string> alarms;   // of the cell's own file, that came
  std::vector<std::string> refused;  // faults that the plant did not take as it stood
  double time_s = 0.0;               // plant time at the end
  std::size_t replans = 0;
  std::uint64_t trace_hash = 0;
};

// Fails with what is wrong with the cell, its plant, planner or program; C0448: it has no simulated plant;
// M0041: it has neither planner nor program, or its program runs on a controller.
[[nodiscard]] result::Result<CellBase> prepare(const CampaignCell& cell);

// `seed`: of the sensors' uncertainty as well.
CellRun run_cell(const CellBase& base, std::uint64_t seed, const Disturbance& disturbance);

}  // namespace stepwright::campaign

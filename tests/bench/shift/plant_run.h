#pragma once

// A shift driven on the simulated plant: SUNDIALS forklifts and Box2D, through measured poses, ten times a
// second, judged at every step of 10 ms.
//
//   const PlantRun run = run_on_plant(scenario, fleet, false);
//   run.judge.collisions().empty();

#include <string>
#include <vector>

#include "tests/bench/shift/figures.h"
#include "tests/bench/shift/fleet.h"
#include "tests/bench/shift/judge.h"
#include "tests/bench/shift/reach.h"
#include "tests/bench/shift/scenario.h"

namespace stepwright::bench::shift {

struct PlantRun {
  ShiftFigures figures;
  std::vector<Collision> collisions;
  std::vector<std::string> deadlocks;
  std::vector<std::string> broken;  // what must hold for there to be none, and did not
  double smallest_gap_m = 0.0;
  double longest_wait_s = 0.0;
  double largest_deviation_m = 0.0;
  std::uint64_t outline_checks = 0;
  std::uint64_t control_steps = 0;
  std::uint32_t lost = 0;
  std::uint32_t contacts = 0;  // that the plant's bumpers felt
  std::vector<std::string> log;
  std::vector<Standing> stood;                      // blocked places, and dead vehicles where they stood
  std::vector<std::vector<geometry::Pose>> tracks;  // by vehicle, every few seconds, for the picture
  std::string failed;                               // why it could not run; empty if all is well
};

// Ends at `until_s`, or with the shift.
PlantRun run_on_plant(const Scenario& scenario, Fleet& fleet, bool progress, double until_s = 1e9);

}  // namespace stepwright::bench::shift

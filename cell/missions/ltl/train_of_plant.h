#pragma once

// The simulated train of a cell ([plant] of kind "tugger") as the mission plans with it, so that both agree:
// figures that the problem does not name are the simulated train's, and no limit is above what that can do.
// Without such a plant the problem and its defaults count alone.
//
// Pure functions; any thread.
//
//   auto problem = ltl::read_planning_problem(text, file, train_of(config.plant));
//   if (auto good = check_agrees(config.plant, problem->train); !good) return result::forward(good);
//   keep_within(config.plant, problem->train);
//   options.program.drive = drive_of(config.plant, table.top_speed_m_s);

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"
#include "supervisor/ltl/program/train_way.h"
#include "supervisor/ltl/train/train_model.h"

namespace stepwright::missions {

// Sizes and limits; how many trailers there are is for the problem to say.
ltl::TrainModel train_of(const config::PlantConfig& plant);

// L0504 at the plant's key: a size that the problem names is another one than the simulated train's, or the
// problem's train has more trailers than can be coupled there.
[[nodiscard]] result::Result<void> check_agrees(const config::PlantConfig& plant,
                                                const ltl::TrainModel& train);

// Limits of speed, steering and their changes: the lower one of both.
void keep_within(const config::PlantConfig& plant, ltl::TrainModel& train);

// How the program drives it: at most half of what the drives can (a quarter where it brakes as planned), with
// their lags.
ltl::TrainDrive drive_of(const config::PlantConfig& plant, double top_speed_m_s);

}  // namespace stepwright::missions

#pragma once

// A small hall with its train: the real planner, compiler, scan and plant in one thread. The judges are the
// plant's: contacts, the least distance of any link from any obstacle.
//
//   TrainHall hall("visit press then visit rack", 2);
//   const run::RunRecord record = hall.run(hall.options());
//   EXPECT_EQ(hall.truth("contacts"), 0.0);

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/ltl/mission/train_mission.h"
#include "tests/support/controller/simulated_controller.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::ltl::testing {

class TrainHall {
 public:
  TrainHall(const std::string& task, std::size_t trailers, std::vector<support::PlantFault> faults = {});

  TrainMissionOptions options() const { return {.cell = "hall", .attended = false}; }
  run::RunRecord run(TrainMissionOptions options, TrainMission::Observer observer = {});
  TrainPlanning& planning() { return *planning_; }
  support::SimulatedController& controller() { return controller_; }
  double truth(const std::string& name) const { return controller_.plant_value(name); }
  std::filesystem::path journal() const { return folder_ / "train.json"; }

 private:
  support::TemporaryFolder folder_;
  Problem problem_;
  std::optional<TrainPlanning> planning_;
  support::SimulatedController controller_;
};

// Phase, message and incidents, for messages of tests.
std::string story(const run::RunRecord& record);

}  // namespace stepwright::ltl::testing

#pragma once

// Pictures of a train's run for the page: the floor with its regions and places, what the train has swept and
// what its plan will sweep, and the task's automaton.
//
// Threads: one at a time. Example:
//   TrainPictures pictures(planning);
//   pictures.drive(*prepared, digest);
//   pictures.cover(reading.arc_m);
//   show(pictures.draw(task, task.text, blocked));

#include <string>
#include <vector>

#include "supervisor/ltl/mission/train_planning.h"
#include "supervisor/run/picture.h"

namespace stepwright::ltl {

class TrainPictures {
 public:
  explicit TrainPictures(const TrainPlanning& planning) : planning_(planning) {}

  // Another run: nothing is planned, and nothing was driven.
  void clear();
  // The plan that is driven from now on, by the program of that digest. What was driven of the one before
  // stays in the picture.
  void drive(const PreparedTrain& plan, std::string program);
  // The train has come so far along that plan's way.
  void cover(double arc_m);

  // `watched`: the task whose monitor is in the scan; of another one no state is known.
  run::Pictures draw(const TrainTask& task, const std::string& watched,
                     const std::vector<Area>& blocked) const;

 private:
  void keep_what_was_driven();
  run::FloorPicture floor(const std::vector<Area>& blocked) const;

  const TrainPlanning& planning_;
  run::FloorPicture plan_;               // its part of the floor's picture
  std::vector<std::string> visited_;     // places, by earlier plans for the task
  std::string task_;                     // of the plan
  std::vector<WayLabel> labels_;         // that it reads
  std::optional<std::uint32_t> begins_;  // state of its task where it begins
};

}  // namespace stepwright::ltl

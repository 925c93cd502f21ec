#pragma once

// A task's automaton as the page draws it: on this floor, where only some letters can be read. Of a large one
// the states that the plan goes through.
//
// A pure function; any thread. Example:
//   const run::AutomatonPicture drawn = task_picture({.task = &task, .places = names, .letters = letters});

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/ltl/mission/train_planning.h"
#include "supervisor/run/picture.h"

namespace stepwright::ltl {

inline constexpr std::size_t kMostDrawnStates = 60;

struct TaskPictureInput {
  const TrainTask* task = nullptr;
  std::vector<std::string> places;
  std::vector<Label> letters;             // that can be read
  std::vector<WayLabel> planned{};        // that the plan reads, from
  std::optional<std::uint32_t> begins{};  // this state; nothing: there is no plan
};

run::AutomatonPicture task_picture(const TaskPictureInput& input);

}  // namespace stepwright::ltl

#pragma once

// Requests to a train while it runs, of people or of the cell's file. Values.

#include <string>
#include <variant>

#include "supervisor/ltl/regions/make_regions.h"

namespace stepwright::ltl {

struct GoalChange {
  std::string task;  // another one, in place of the one that is driven
};
struct BlockChange {
  Area area;  // something stands there, or a place is out of service
};
struct UnblockChange {
  std::string name;
};
struct HoldChange {};
struct ResumeChange {};

using TrainChange = std::variant<GoalChange, BlockChange, UnblockChange, HoldChange, ResumeChange>;

struct TimedTrainRequest {
  double at_s = 0.0;  // of the scan clock
  TrainChange change;
};

}  // namespace stepwright::ltl

#pragma once

// Requests to two arms while they work, of people or of the cell's file. Values.

#include <string>
#include <variant>

namespace stepwright::tamp::mission {

struct GoalChange {
  std::string order;  // its name, or a goal in PDDL; in place of the one that is worked on
};
struct HoldChange {};
struct ResumeChange {};

using ArmsChange = std::variant<GoalChange, HoldChange, ResumeChange>;

struct TimedArmsRequest {
  double at_s = 0.0;  // of the scan clock
  ArmsChange change;
};

}  // namespace stepwright::tamp::mission

#pragma once

// Form in which a page puts a goal together without knowing the domain, as JSON (supervisor/doc/goals.md):
// the form itself, which stays the same for as long as the supervisor runs, and the present, which changes
// with the run.
//
// Functions are pure; any thread.

#include <optional>
#include <set>
#include <string>

#include "supervisor/executive/outlook.h"
#include "supervisor/executive/planning_service.h"

namespace stepwright::executive {

// Longer ones are not published: a form with that many choices is of no use to anybody, and goals can be
// typed all the same.
inline constexpr std::size_t kMaxGoalFormBytes = 512u << 10;
// Of facts and fluents, which travel again and again; likewise.
inline constexpr std::size_t kMaxStateBytes = 64u << 10;

// The words of the domain, the objects of its types, and what the binding knows of each sensor.
std::string goal_form_json(const PlanningService& planning);

// Writes what holds now, again and again; what of that only depends on the problem or the goal it works out
// once. One thread at a time; the service must outlive it.
class OutlookWriter {
 public:
  explicit OutlookWriter(const PlanningService& planning);

  // With the goal, and with `what_if` (JSON: WhatIf::answer).
  std::string json(const Outlook& outlook, const std::string& what_if);

 private:
  const PlanningService& planning_;
  std::set<std::string, std::less<>> predicates_;  // that goals can speak of
  std::optional<std::string> goal_;                // of goal_text_
  std::string goal_text_;
};

}  // namespace stepwright::executive

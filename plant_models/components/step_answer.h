#pragma once

// Answer of a described plant, left to itself: its terminals are set at given instants, and values are noted
// once for each interval. As a table (CSV) and as a picture (SVG).
//
//   StepAnswer answer = record_answer(plant, {.seconds = 60.0, .values = {"a1.level"}, .actions =
//   {{"B1", 1.0, 5.0, false}}});

#include <chrono>
#include <string>
#include <vector>

#include "plant_models/core/plant.h"
#include "runtime/ground/result/result.h"

namespace stepwright::components {

// Something that is done to the plant at an instant.
struct AnswerAction {
  std::string name;  // of an actuator or a fault
  double value = 0.0;
  double at_s = 0.0;
  bool fault = false;
};

struct AnswerRequest {
  double seconds = 60.0;
  std::chrono::nanoseconds interval{10'000'000};
  std::vector<std::string> values;  // truths and terminals; none: all that change
  std::vector<AnswerAction> actions;
};

struct AnswerColumn {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

struct StepAnswer {
  std::vector<double> times_s;
  std::vector<AnswerColumn> columns;
  bool failed = false;  // the solver gave up at the last of the times
};

// The last row is the end, however long the interval. Fails with C0301 (no such terminal or value), C0350 (a
// terminal cannot have the value, or is set after the end) and what a fault is refused with.
[[nodiscard]] result::Result<StepAnswer> record_answer(core::Plant& plant, const AnswerRequest& request);

std::string to_csv(const StepAnswer& answer);
// A panel for each unit, curves by colour and name.
std::string to_svg(const StepAnswer& answer, const std::string& title);

}  // namespace stepwright::components

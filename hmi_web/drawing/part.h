#pragma once

// An operator part of a drawing: what somebody may do with a value there, and the frames in which the page
// shows lists and trends of its own (hmi_web/doc/screens.md).
//
//   <g data-part="setpoint" data-key="level" data-write="Main.level" data-from="0" data-to="100">...</g>
//
// Plain values.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::drawing {

enum class PartKind : unsigned char {
  Button,     // writes one value
  Switch,     // TRUE or FALSE
  SetPoint,   // a number within a range
  Slider,     // likewise
  Choice,     // one of some values
  StartStop,  // TRUE to start; to stop FALSE, or TRUE to another variable
  Navigate,   // leads to another screen
  Trend,
  Alarms,
  Tags,
};

struct Part {
  PartKind kind = PartKind::Button;
  std::string key;              // its name in the drawing; of what writes, never empty
  std::string write;            // the variable
  std::string stop;             // of a pair: the variable that stops; empty: FALSE to `write`
  std::string value;            // of a button: the literal
  std::optional<double> least;  // of a set point and a slider; a TIME in seconds
  std::optional<double> most;
  std::vector<std::pair<std::string, std::string>> values;  // of a choice: literal and name
  std::string confirm;                                      // the question before it writes; empty: none
  bool engineer = false;                                    // only engineers and those above
  result::Location where = {};
};

bool writes(PartKind kind);
// "set point".
const char* word_of(PartKind kind);

}  // namespace stepwright::drawing

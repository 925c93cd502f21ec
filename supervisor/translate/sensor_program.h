#pragma once

// The globals of a cell and the program that runs before the chart in every scan and filters the sensors.
//
// Filter: first-order low-pass, y := y + (1 - exp(-interval / filter time)) * (x - y), started at the first
// sample. It contracts, so rounding does not add up: the error stays below half a count at 16-bit counts.
// Mean: while `averaging` is true, an exact DINT sum of counts divided by their number; it keeps the last
// mean afterwards, and what it was after `half_samples` in `half_variable(sensor)`; sums begin anew when
// `averaging` does. Both write
// `filtered_variable(sensor)` in the type of the sensor's tag.
//
// Rate, in both modes: where a sensor has `max_rate`, its counts are compared with the filter's state in
// every scan (internal/rate.h). `leaping_variable(sensor)` counts the scans in a row in which they change too
// fast and stays at kLeapingScans once it is there. Filters and counts go on when one program takes over from
// another, so that a leap is seen across the change, too.

#include <cstdint>
#include <set>
#include <string>

#include "ladder/graphic/project.h"
#include "supervisor/translate/sensor_condition.h"

namespace stepwright::translate {

inline constexpr const char* kSensorProgram = "sensors";
inline constexpr const char* kPlanProgram = "plan";
inline constexpr const char* kPlanInstance = "planned";
inline constexpr const char* kAveragingVariable = "averaging";

enum class SensorMode : std::uint8_t { Filter, Mean };

struct SensorProgramOptions {
  SensorMode mode = SensorMode::Filter;
  std::int64_t interval_us = 10'000;
  std::int64_t half_samples = 1;  // Mean: half as many as there will be
  std::set<std::string> values;   // sensors (by name) whose calibrated level `value_variable` is computed too
  Tare tare;                      // subtracted for `values`
};

// Tags and generated variables as globals.
std::vector<graphic::Variable> cell_globals(const Binding& binding, const SensorProgramOptions& options);
// The scans in a row for which a sensor with `max_rate` has changed faster than its level can; DINT.
std::string leaping_variable(const Sensor& sensor);
// A disturbed sample alone is no leap: so many in a row are, and the sensor has failed.
inline constexpr int kLeapingScans = 3;
// The names of the variables that are generated for one sensor, in any mode.
std::vector<std::string> generated_variables(const Sensor& sensor);
// The names of all variables that a generated program may declare, tags included.
std::vector<std::string> declared_variables(const Binding& binding);
// True if the variable `name` stands in the ST text.
bool mentions(const std::string& text, const std::string& name);
// The program, which declares the globals it uses as VAR_EXTERNAL.
graphic::Pou sensor_program(const Binding& binding, const SensorProgramOptions& options);

// A project of the globals, the sensor program and the chart, in one task in this order.
graphic::Project make_project(const Binding& binding, const SensorProgramOptions& options,
                              graphic::SfcChart chart);

}  // namespace stepwright::translate

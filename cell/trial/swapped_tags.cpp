#include "cell/trial/swapped_tags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cell/trial/level_change.h"

namespace stepwright::trial {
namespace {

using translate::Binding;
using translate::ObservedFact;
using translate::Sensor;

// What `sensor` would show with the counts at which `other` shows `value`.
double shown_with(const Sensor& sensor, const Sensor& other, double value) {
  return sensor.calibration.value_at(other.calibration.counts_at(value));
}

bool is_right(const Sensor& sensor, const ActionRun& run) {
  return std::abs(value_of(run.after, sensor.fluent) - value_of(run.expected, sensor.fluent)) <=
         sensor.tolerance;
}

// Whether `sensor` would be right with the tag of `other`.
bool is_right_with(const Sensor& sensor, const Sensor& other, const ActionRun& run) {
  const double value = value_of(run.after, other.fluent);
  const double shown = shown_with(sensor, other, value);
  const double tolerance = std::abs(shown_with(sensor, other, value + other.tolerance) - shown);
  return std::abs(shown - value_of(run.expected, sensor.fluent)) <= std::max(sensor.tolerance, tolerance);
}

bool is_right(const ObservedFact& fact, const ActionRun& run) {
  return (value_of(run.after, fact.fact) > 0.5) == (value_of(run.expected, fact.fact) > 0.5);
}

bool is_right_with(const ObservedFact& fact, const ObservedFact& other, const ActionRun& run) {
  const bool input = (value_of(run.after, other.fact) > 0.5) != other.inverted;
  return (input != fact.inverted) == (value_of(run.expected, fact.fact) > 0.5);
}

std::string lines(const std::string& tag, const std::string& of, const std::string& other_tag,
                  const std::string& other) {
  return fmt::format(
      "each shows what the other one should: tag = \"{}\" for '{}' and tag = \"{}\" for '{}'; or ", other_tag,
      of, tag, other);
}

// Of two, as long as no third one is wrong: then which two it is cannot be told.
std::string swapped_facts(const Binding& binding, const ActionRun& run) {
  std::vector<const ObservedFact*> wrong;
  for (const ObservedFact& fact : binding.facts)
    if (!is_right(fact, run)) wrong.push_back(&fact);
  if (wrong.size() != 2) return {};
  const ObservedFact& a = *wrong[0];
  const ObservedFact& b = *wrong[1];
  if (!is_right_with(a, b, run) || !is_right_with(b, a, run)) return {};
  return lines(a.tag, a.fact, b.tag, b.fact);
}

std::string swapped_sensors(const Binding& binding, const ActionRun& run) {
  for (const Sensor& a : binding.sensors) {
    for (const Sensor& b : binding.sensors) {
      if (&a >= &b || is_right(a, run) || is_right(b, run)) continue;
      if (is_right_with(a, b, run) && is_right_with(b, a, run)) return lines(a.tag, a.name, b.tag, b.name);
    }
  }
  return {};
}

}  // namespace

std::string swapped_tags(const Binding& binding, const ActionRun& run) {
  return swapped_sensors(binding, run) + swapped_facts(binding, run);
}

}  // namespace stepwright::trial

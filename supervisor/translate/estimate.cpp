#include "supervisor/translate/estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace stepwright::translate {

namespace {

double rounded(double value, double resolution) {
  if (resolution <= 0.0) return value;
  return std::round(value / resolution) * resolution + 0.0;  // + 0.0: no negative zero in a planning problem
}

// The other multiple beside a value.
double rounded_away(double value, double resolution) {
  const double nearest = rounded(value, resolution);
  return nearest + std::copysign(resolution, value - nearest) + 0.0;
}

result::Result<double> read(const Values& values, const std::string& name) {
  const auto found = values.find(name);
  if (found != values.end() && std::isfinite(found->second)) return found->second;
  return result::fail("T0010", {}, "the controller reports no value of '" + name + "'");
}

// The resolution in which a planner may know `fluent`: a sensor's own, or for the target of transfers that
// of the sensors at their source. 0 = as it is.
double resolution_of(const std::string& fluent, const Binding& binding) {
  if (const Sensor* sensor = binding.sensor_of(fluent)) return sensor->resolution;
  const auto atom = parse_pattern(fluent);
  double coarsest = 0.0;
  for (const ActionBinding& action : binding.actions) {
    for (const Transfer& transfer : action.transfers) {
      const bool target =
          atom && atom->name == transfer.to.name && atom->arguments.size() == transfer.to.arguments.size();
      for (const Sensor& sensor : binding.sensors) {
        const auto source = parse_pattern(sensor.fluent);
        if (!target || !source || source->name != transfer.from.name) continue;
        coarsest = std::max(coarsest, sensor.resolution * transfer.ratio);
      }
    }
  }
  return coarsest;
}

// Adds what running actions have moved so far to the fluents that no sensor sees.
void add_transfers(const Binding& binding, const model::GroundAction& running,
                   const model::NamedState& tracked, Estimate& estimate) {
  Assignment assignment;
  const ActionBinding* entry = binding.action_for(running, assignment);
  if (entry == nullptr) return;
  for (const Transfer& transfer : entry->transfers) {
    const std::string from = instantiate(transfer.from, assignment);
    const std::string to = instantiate(transfer.to, assignment);
    const Sensor* sensor = binding.sensor_of(from);
    const auto before = tracked.fluents.find(from);
    if (sensor == nullptr || before == tracked.fluents.end()) continue;
    const double left = before->second - estimate.measured.fluents[from];
    const double left_rounded = rounded(before->second, sensor->resolution) - estimate.planning.fluents[from];
    estimate.measured.fluents[to] += transfer.ratio * std::max(left, 0.0);
    estimate.planning.fluents[to] += transfer.ratio * std::max(left_rounded, 0.0);
  }
}

std::string list_of(const std::vector<std::string>& labels, const char* last_link) {
  std::string text;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (i != 0) text += i + 1 == labels.size() ? last_link : ", ";
    text += "'" + labels[i] + "'";
  }
  return text;
}

void check_groups(const Binding& binding, std::span<const model::GroundAction> in_progress,
                  Estimate& estimate) {
  std::set<std::string> on_the_way;  // facts that running actions are about to bring about
  for (const model::GroundAction& running : in_progress) {
    Assignment assignment;
    const ActionBinding* entry = binding.action_for(running, assignment);
    if (entry == nullptr || entry->completion.kind != CompletionKind::Fact) continue;
    on_the_way.insert(instantiate(entry->completion.atom, assignment));
  }
  for (const OneOf& group : binding.one_of) {
    std::vector<std::string> all;
    std::vector<std::string> observed;
    bool in_motion = false;
    for (const std::string& fact : group.facts) {
      all.push_back(binding.observed(fact)->label);
      if (estimate.measured.facts.contains(fact)) observed.push_back(all.back());
      in_motion = in_motion || on_the_way.contains(fact);
    }
    if (observed.size() > 1) {
      estimate.contradictions.push_back(list_of(observed, " and ") + " are observed together");
    } else if (observed.empty() && !in_motion) {
      estimate.contradictions.push_back("none of " + list_of(all, " and ") + " is observed");
    }
  }
}

// Two decimals at most, one at least: "3.9", "4.78"; more where a tolerance is smaller than that.
std::string level_text(double value, int digits = 2) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  std::string trimmed = text;
  while (trimmed.back() == '0' && trimmed[trimmed.size() - 2] != '.') trimmed.pop_back();
  return trimmed;
}

// Decimals in which a tolerance, and what is beyond it, can be seen.
int digits_of(double tolerance) {
  constexpr double kMost = 9.0;
  if (tolerance <= 0.0) return 2;
  return static_cast<int>(std::clamp(std::ceil(-std::log10(tolerance)), 2.0, kMost));
}

}  // namespace

result::Result<Estimate> estimate(const Binding& binding, const Values& values, const Tare& tare,
                                  const model::NamedState& tracked,
                                  std::span<const model::GroundAction> in_progress,
                                  const std::set<std::string>& away) {
  Estimate estimate;
  estimate.measured = tracked;
  for (const ObservedFact& fact : binding.facts) {
    auto value = read(values, fact.tag);
    if (!value) return result::forward(value);
    if ((*value != 0.0) != fact.inverted) {
      estimate.measured.facts.insert(fact.fact);
    } else {
      estimate.measured.facts.erase(fact.fact);
    }
  }
  for (const Sensor& sensor : binding.sensors) {
    auto counts = read(values, filtered_variable(sensor));
    if (!counts) return result::forward(counts);
    estimate.measured.fluents[sensor.fluent] = sensor.calibration.value_at(*counts - tare_of(tare, sensor));
  }
  estimate.planning = estimate.measured;
  for (auto& [fluent, value] : estimate.planning.fluents) {
    const double resolution = resolution_of(fluent, binding);
    value = away.contains(fluent) ? rounded_away(value, resolution) : rounded(value, resolution);
  }
  for (const model::GroundAction& running : in_progress) add_transfers(binding, running, tracked, estimate);
  check_groups(binding, in_progress, estimate);
  return estimate;
}

std::vector<Difference> differences(const Binding& binding, const model::NamedState& expected,
                                    const model::NamedState& measured, const std::set<std::string>& ignored) {
  std::vector<Difference> found;
  for (const Sensor& sensor : binding.sensors) {
    const auto should = expected.fluents.find(sensor.fluent);
    const auto is = measured.fluents.find(sensor.fluent);
    if (ignored.contains(sensor.fluent)) continue;
    if (should == expected.fluents.end() || is == measured.fluents.end()) continue;
    if (std::abs(is->second - should->second) <= sensor.tolerance) continue;
    found.push_back({sensor.fluent, sensor.label, false, should->second, is->second, sensor.tolerance});
  }
  for (const ObservedFact& fact : binding.facts) {
    const bool should = expected.facts.contains(fact.fact);
    const bool is = measured.facts.contains(fact.fact);
    if (is == should || ignored.contains(fact.fact)) continue;
    found.push_back({fact.fact, fact.label, true, should ? 1.0 : 0.0, is ? 1.0 : 0.0, 0.0});
  }
  return found;
}

std::string to_string(const Difference& difference) {
  if (difference.is_fact) {
    return "'" + difference.label + "' is " +
           (difference.measured != 0.0 ? "observed, but not expected" : "not observed, but expected");
  }
  const int digits = digits_of(difference.tolerance);
  return difference.label + " is " + level_text(difference.measured, digits) + ", expected " +
         level_text(difference.expected, digits) + " (tolerance " + level_text(difference.tolerance, digits) +
         ")";
}

std::vector<std::string> deviations(const Binding& binding, const model::NamedState& expected,
                                    const model::NamedState& measured, const std::set<std::string>& ignored) {
  std::vector<std::string> sentences;
  for (const Difference& difference : differences(binding, expected, measured, ignored)) {
    sentences.push_back(to_string(difference));
  }
  return sentences;
}

result::Result<std::vector<std::string>> movements(const Binding& binding, const Values& means) {
  std::vector<std::string> moving;
  for (const Sensor& sensor : binding.sensors) {
    auto whole = read(means, filtered_variable(sensor));
    auto half = read(means, half_variable(sensor));
    if (!whole || !half) return result::forward(whole ? half : whole);
    const double first = sensor.calibration.value_at(*half);
    const double second = sensor.calibration.value_at(2.0 * *whole - *half);
    if (std::abs(second - first) <= sensor.tolerance) continue;
    moving.push_back(sensor.label + " moves: " + level_text(first) + ", then " + level_text(second));
  }
  return moving;
}

result::Result<Tare> identify_tare(const Binding& binding, const Values& means,
                                   const model::NamedState& known) {
  Tare tare;
  for (const Sensor& sensor : binding.sensors) {
    if (!sensor.tare) continue;
    auto counts = read(means, filtered_variable(sensor));
    if (!counts) return result::forward(counts);
    const auto level = known.fluents.find(sensor.fluent);
    if (level == known.fluents.end()) {
      return result::fail(
          "T0010", {},
          "the " + sensor.label + " is not known, so sensor " + sensor.name + " cannot be tared");
    }
    const double bias = *counts - sensor.calibration.counts_at(level->second);
    if (std::abs(bias) > sensor.max_bias_counts) {
      return result::fail("T0011", {},
                          "sensor " + sensor.name + " shows " + level_text(*counts) + " counts at " +
                              sensor.label + " = " + level_text(level->second) + ": " + level_text(bias) +
                              " off, more than the " + level_text(sensor.max_bias_counts) + " allowed",
                          "check the sensor, and that the plant stands as the problem's initial state says");
    }
    tare[sensor.name] = bias;
  }
  return tare;
}

}  // namespace stepwright::translate

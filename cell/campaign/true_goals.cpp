#include "cell/campaign/true_goals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "plant_models/core/names.h"

namespace stepwright::campaign {
namespace {

// What a level moves in the time of its filter, with noise, while something runs out at the end.
constexpr double kMotion = 0.15;

struct Comparison {
  std::string relation;
  double number = 0.0;
};

// "(= (level a1) 5)" about "(level a1)".
std::optional<Comparison> comparison_about(const std::string& goal, const std::string& fluent) {
  const std::size_t at = goal.find(fluent + " ");
  if (at == std::string::npos || at < 3 || goal.front() != '(') return std::nullopt;
  const std::string relation = goal.substr(1, at - 2);
  const char* const text = goal.c_str() + at + fluent.size();
  char* end = nullptr;
  const double number = std::strtod(text, &end);
  const bool known =
      relation == "=" || relation == ">=" || relation == "<=" || relation == ">" || relation == "<";
  if (end == text || *end != ')' || !known) return std::nullopt;
  return Comparison{relation, number};
}

bool holds(const Comparison& wanted, double is, double slack) {
  if (wanted.relation.front() == '>') return is >= wanted.number - slack;
  if (wanted.relation.front() == '<') return is <= wanted.number + slack;
  return std::abs(is - wanted.number) <= slack;
}

}  // namespace

std::optional<double> true_value(const translate::Sensor& sensor, const translate::Binding& binding,
                                 const std::vector<bridge::PortWire>& wires, const core::Plant& plant) {
  const translate::Tag* const tag = binding.tag(sensor.tag);
  if (tag == nullptr) return std::nullopt;
  const auto wire = std::ranges::find_if(
      wires, [&](const bridge::PortWire& each) { return core::same_name(each.address, tag->address); });
  if (wire == wires.end()) return std::nullopt;
  for (const core::SensorDescription& each : plant.description().sensors) {
    if (!core::same_name(each.name, wire->port)) continue;
    const auto truth = core::find_truth(plant, each.measures);
    if (!truth) return std::nullopt;
    return sensor.calibration.value_at(each.counts_at_zero + each.counts_per_unit * plant.truth(*truth));
  }
  return std::nullopt;
}

std::string wrong_goal(const run::RunRecord& record, const translate::Binding& binding,
                       const std::vector<bridge::PortWire>& wires, const core::Plant& plant, bool faulty) {
  for (const translate::Sensor& sensor : binding.sensors) {
    for (const run::GoalRecord& goal : record.goal) {
      const auto wanted = comparison_about(goal.text, sensor.fluent);
      if (!wanted) continue;
      const auto is = true_value(sensor, binding, wires, plant);
      const double slack = sensor.tolerance + (faulty ? 2.0 * sensor.max_drift : kMotion);
      if (is && !holds(*wanted, *is, slack))
        return fmt::format("{}: it is {:.3g} in the plant", goal.text, *is);
    }
  }
  return {};
}

}  // namespace stepwright::campaign

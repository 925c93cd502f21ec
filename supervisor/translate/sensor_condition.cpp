#include "supervisor/translate/sensor_condition.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace stepwright::translate {

namespace {

using graphic::CompareOp;
using graphic::Condition;
using graphic::ConditionKind;

Condition compare_counts(const Sensor& sensor, CompareOp op, const Threshold& limit) {
  return graphic::compare(filtered_variable(sensor), op, std::to_string(limit.counts));
}

CompareOp opposite(CompareOp op) {
  switch (op) {
    case CompareOp::Equal:
      return CompareOp::NotEqual;
    case CompareOp::NotEqual:
      return CompareOp::Equal;
    case CompareOp::Less:
      return CompareOp::GreaterEqual;
    case CompareOp::LessEqual:
      return CompareOp::Greater;
    case CompareOp::Greater:
      return CompareOp::LessEqual;
    case CompareOp::GreaterEqual:
      return CompareOp::Less;
  }
  return op;
}

}  // namespace

double tare_of(const Tare& tare, const Sensor& sensor) {
  const auto found = tare.find(sensor.name);
  return found == tare.end() ? 0.0 : found->second;
}

Threshold threshold(const Sensor& sensor, const std::string& type, const Tare& tare, double value) {
  const double low = type == "UINT" ? 0.0 : -32'768.0;
  const double high = type == "UINT" ? 65'535.0 : 32'767.0;
  const double exact = sensor.calibration.counts_at(value) + tare_of(tare, sensor);
  const double counts = std::round(exact);
  return {std::lround(std::clamp(counts, low, high)), counts < low || counts > high};
}

Condition at_least(const Sensor& sensor, const std::string& type, const Tare& tare, double value) {
  const CompareOp op = sensor.calibration.rising() ? CompareOp::GreaterEqual : CompareOp::LessEqual;
  return compare_counts(sensor, op, threshold(sensor, type, tare, value));
}

Condition at_most(const Sensor& sensor, const std::string& type, const Tare& tare, double value) {
  const CompareOp op = sensor.calibration.rising() ? CompareOp::LessEqual : CompareOp::GreaterEqual;
  return compare_counts(sensor, op, threshold(sensor, type, tare, value));
}

Condition near(const Sensor& sensor, const std::string& type, const Tare& tare, double value,
               double tolerance) {
  return graphic::all(
      {at_least(sensor, type, tare, value - tolerance), at_most(sensor, type, tare, value + tolerance)});
}

Condition fact_is(const ObservedFact& fact, bool expected) {
  return graphic::contact(fact.tag, fact.inverted == expected);
}

Condition without(const Condition& condition, const Condition& known) {
  const auto parts = [](const Condition& whole) {
    return whole.kind == ConditionKind::All ? whole.children : std::vector<Condition>{whole};
  };
  const std::vector<Condition> given = parts(known);
  std::vector<Condition> left;
  for (const Condition& part : parts(condition)) {
    if (std::find(given.begin(), given.end(), part) == given.end()) left.push_back(part);
  }
  return graphic::all(std::move(left));
}

std::optional<Condition> inverse(const Condition& condition) {
  assert(condition.edge == graphic::Edge::None);
  Condition opposed = condition;
  switch (condition.kind) {
    case ConditionKind::True:
      return std::nullopt;
    case ConditionKind::Contact:
    case ConditionKind::Expression:
      opposed.negated = !condition.negated;
      return opposed;
    case ConditionKind::Comparison:
      opposed.op = opposite(condition.op);
      return opposed;
    case ConditionKind::All:
    case ConditionKind::Any:
      break;
  }
  std::vector<Condition> children;
  for (const Condition& child : condition.children) {
    auto part = inverse(child);
    if (!part && condition.kind == ConditionKind::Any) return std::nullopt;
    if (part) children.push_back(std::move(*part));
  }
  if (children.empty()) return std::nullopt;
  return condition.kind == ConditionKind::All ? graphic::any(std::move(children))
                                              : graphic::all(std::move(children));
}

}  // namespace stepwright::translate

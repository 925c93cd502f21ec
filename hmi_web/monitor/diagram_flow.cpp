#include "hmi_web/monitor/diagram_flow.h"

namespace stepwright::monitor {

using syntax::Operator;

Value DiagramFlow::of(std::size_t element, const std::string& output) {
  Place place{element, folded(output)};
  if (const auto known = known_.find(place); known != known_.end()) return known->second;
  if (element >= diagram_.elements.size() || running_.size() >= kDeepest) return std::nullopt;
  if (!running_.insert(place).second) return std::nullopt;
  Value value = compute(diagram_.elements[element], output);
  running_.erase(place);
  known_.emplace(std::move(place), value);
  return value;
}

// What arrives at an input.
Value DiagramFlow::at(const Pin& pin) {
  if (pin.edge) return std::nullopt;
  Value value;
  if (pin.has_text) {
    value = evaluator_.value(pin.text.expression);
  } else {
    for (std::size_t i = 0; i < pin.connections.size(); ++i) {
      const Value next = of(pin.connections[i].first, pin.connections[i].second);
      value = i == 0 ? next : evaluator_.combine(Operator::Or, value, next);
    }
  }
  return pin.negated ? evaluator_.invert(value) : value;
}

Value DiagramFlow::first(const Element& element) {
  return element.inputs.empty() ? std::nullopt : at(element.inputs.front());
}

Value DiagramFlow::variable(const Element& element) const {
  const Value value = element.edge ? std::nullopt : evaluator_.value(element.name.expression);
  return element.negated ? evaluator_.invert(value) : value;
}

Value DiagramFlow::compute(const Element& element, const std::string& output) {
  if (element.kind == "inVariable" || element.kind == "inOutVariable") return variable(element);
  if (element.kind == "block") return block(element, output);
  if (element.kind == "leftPowerRail") return evaluator_.boolean(true);
  if (element.kind == "contact") return evaluator_.combine(Operator::And, first(element), variable(element));
  if (element.kind == "continuation") {
    const std::string name = folded(element.name.text);
    for (const Element& each : diagram_.elements)
      if (each.kind == "connector" && folded(each.name.text) == name) return first(each);
    return std::nullopt;
  }
  return first(element);
}

Value DiagramFlow::block(const Element& element, const std::string& output) {
  const Pin* pin = element.outputs.empty() ? nullptr : &element.outputs.front();
  for (const Pin& each : element.outputs)
    if (folded(each.name) == folded(output)) {
      pin = &each;
      break;
    }
  const std::string& name = pin != nullptr ? pin->name : output;
  const Pin* enable = nullptr;
  std::vector<Value> inputs;
  for (const Pin& each : element.inputs) {
    if (folded(each.name) == "EN") {
      enable = &each;
    } else if (element.instance.empty()) {
      inputs.push_back(at(each));
    }
  }
  const Value power = enable != nullptr ? at(*enable) : evaluator_.boolean(true);
  Value value;
  if (folded(name) == "ENO") {
    value = power;
  } else if (!element.instance.empty()) {
    value = lookup_(element.instance + '.' + name);
  } else if (is_true(power)) {
    value = evaluator_.call(element.name.text, inputs);
  }
  return pin != nullptr && pin->negated ? evaluator_.invert(value) : value;
}

}  // namespace stepwright::monitor

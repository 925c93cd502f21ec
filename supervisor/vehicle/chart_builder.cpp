#include "supervisor/vehicle/chart_builder.h"

#include <fmt/format.h>

#include <cstdint>

namespace stepwright::vehicle {

graphic::StepId ChartBuilder::step(std::string name, std::string comment) {
  graphic::Step step;
  step.name = std::move(name);
  step.initial = chart_.steps.empty();
  step.comment = std::move(comment);
  chart_.steps.push_back(std::move(step));
  return graphic::StepId(static_cast<std::uint32_t>(chart_.steps.size() - 1));
}

void ChartBuilder::action(const std::string& name, std::string body, graphic::Qualifier qualifier) {
  chart_.actions.push_back({.name = name, .st_body = std::move(body)});
  drives(name, qualifier);
}

void ChartBuilder::drives(const std::string& target, graphic::Qualifier qualifier) {
  graphic::ActionBlock block;
  block.qualifier = qualifier;
  block.target = target;
  chart_.steps.back().actions.push_back(std::move(block));
}

void ChartBuilder::transition(graphic::StepId from, graphic::StepId to, graphic::Condition condition,
                              std::string comment) {
  graphic::Transition made;
  made.name = fmt::format("T{:03}", chart_.transitions.size());
  made.sources = {from};
  made.targets = {to};
  made.condition = std::move(condition);
  made.comment = std::move(comment);
  made.priority = static_cast<int>(chart_.transitions.size()) + 1;
  chart_.transitions.push_back(std::move(made));
}

}  // namespace stepwright::vehicle

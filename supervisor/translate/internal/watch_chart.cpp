#include "supervisor/translate/internal/watch_chart.h"

#include <utility>

#include "supervisor/translate/monitors.h"

namespace stepwright::translate::internal {
namespace {

using graphic::Condition;
using graphic::Variable;
using graphic::VariableSection;

Variable variable(std::string name, VariableSection section) {
  Variable declared;
  declared.name = std::move(name);
  declared.type = "UDINT";
  declared.section = section;
  return declared;
}

}  // namespace

// QUIET -> RAISED in the scan of an alarm, and back in the next one.
graphic::Pou watch_program(const std::string& count) {
  graphic::SfcChart chart;
  graphic::Step quiet;
  quiet.name = "QUIET";
  quiet.initial = true;
  graphic::Step raised;
  raised.name = "RAISED";
  raised.actions.push_back({graphic::Qualifier::N, "TELL"});
  chart.steps = {std::move(quiet), std::move(raised)};
  chart.actions.push_back({"TELL", std::string(kAlarmsTold) + " := " + count + ";"});
  const auto add = [&chart](std::uint32_t from, std::uint32_t to, Condition condition) {
    graphic::Transition transition;
    transition.name = "T" + std::to_string(from + 1);
    transition.sources = {graphic::StepId(from)};
    transition.targets = {graphic::StepId(to)};
    transition.condition = std::move(condition);
    chart.transitions.push_back(std::move(transition));
  };
  add(0, 1, graphic::compare(count, graphic::CompareOp::NotEqual, kAlarmsTold));
  add(1, 0, graphic::always());
  graphic::Pou pou;
  pou.name = kWatchProgram;
  pou.variables = {variable(count, VariableSection::External), variable(kAlarmsTold, VariableSection::Local)};
  pou.body = std::move(chart);
  return pou;
}

}  // namespace stepwright::translate::internal

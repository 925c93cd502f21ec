#include "supervisor/translate/chart_writer.h"

#include <cassert>
#include <cstdio>
#include <utility>

#include "supervisor/translate/sensor_program.h"

namespace stepwright::translate {

ChartWriter::ChartWriter(const Binding& binding) : file_(binding.file) {
  for (const std::string& name : declared_variables(binding)) names_.insert(name);
}

graphic::StepId ChartWriter::step(StepInfo info, std::string comment,
                                  const std::vector<std::string>& outputs) {
  if (!names_.insert(info.name)) {
    result::Diagnostic problem;
    problem.code = "T0006";
    problem.where.file = file_;
    problem.message = "the step '" + info.name + "' has the name of a variable or of another step";
    problem.hint = "rename the tag";
    problems_.push_back(std::move(problem));
  }
  graphic::Step step;
  step.name = info.name;
  step.initial = chart_.steps.empty();
  step.comment = std::move(comment);
  for (const std::string& output : outputs) {
    graphic::ActionBlock block;
    block.target = output;
    step.actions.push_back(std::move(block));
  }
  chart_.steps.push_back(std::move(step));
  steps_.push_back(std::move(info));
  return graphic::StepId(static_cast<std::uint32_t>(chart_.steps.size() - 1));
}

void ChartWriter::transition(std::vector<graphic::StepId> sources, std::vector<graphic::StepId> targets,
                             graphic::Condition condition, std::string comment) {
  char name[16];
  std::snprintf(name, sizeof name, "T%02zu", chart_.transitions.size());
  graphic::Transition transition;
  transition.name = names_.unique(name);
  transition.sources = std::move(sources);
  transition.targets = std::move(targets);
  transition.condition = std::move(condition);
  transition.priority = static_cast<int>(chart_.transitions.size()) + 1;
  transition.comment = std::move(comment);
  chart_.transitions.push_back(std::move(transition));
}

graphic::Condition ChartWriter::after(graphic::StepId step, milliseconds time) const {
  return graphic::compare(chart_.steps[step.value].name + ".T", graphic::CompareOp::GreaterEqual,
                          time_literal(time));
}

std::string time_literal(milliseconds time) {
  assert(time.count() >= 0);
  const long long total = time.count();
  if (total % 1'000 == 0) return "T#" + std::to_string(total / 1'000) + "s";
  return "T#" + std::to_string(total) + "ms";
}

}  // namespace stepwright::translate

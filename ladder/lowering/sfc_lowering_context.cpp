#include "ladder/lowering/sfc_lowering_context.h"

#include <algorithm>
#include <utility>

#include "ladder/lowering/st_names.h"

namespace stepwright::lowering {
namespace {

using graphic::ActionBlock;
using graphic::Condition;
using graphic::Qualifier;
using graphic::SfcChart;

template <typename Visit>
void for_each_text_of(const Condition& condition, Visit& visit) {
  visit(condition.name);
  visit(condition.operand);
  for (const Condition& child : condition.children) for_each_text_of(child, visit);
}

bool has_edge_action(const graphic::Step& step) {
  return std::any_of(step.actions.begin(), step.actions.end(), [](const ActionBlock& block) {
    return block.qualifier == Qualifier::P || block.qualifier == Qualifier::P0 ||
           block.qualifier == Qualifier::P1;
  });
}

}  // namespace

SfcLoweringContext::SfcLoweringContext(const graphic::Pou& pou, ChartNetworks networks)
    : pou_(pou), networks_(std::move(networks)) {
  pou_.origin = std::get<SfcChart>(pou.body);
  pou_.step_variables.clear();
  pou_.transition_variables.clear();
  index_names();
  reserve_names();
  declare_steps();
  declare_transitions();
  declare_actions();
  pou_.first_scan_variable = declare("SFC_FIRST_SCAN", "BOOL", "TRUE in the first scan", "TRUE");
}

template <typename Visit>
void SfcLoweringContext::for_each_text(Visit visit) const {
  for (const graphic::Transition& transition : chart().transitions) {
    for_each_text_of(transition.condition, visit);
  }
  for (const graphic::Step& step : chart().steps) {
    for (const ActionBlock& block : step.actions) {
      visit(block.target);
      visit(block.duration);
      visit(block.indicator);
    }
  }
  for (const graphic::Action& action : chart().actions) visit(action.st_body);
  for (const ConditionNetwork& network : networks_.conditions) visit(network.statements);
  for (const graphic::Rung& rung : networks_.every_scan.rungs) {
    for_each_text_of(rung.condition, visit);
    for (const graphic::Block& block : rung.blocks) {
      for (const auto& [pin, value] : block.inputs) visit(value);
      visit(block.st_body);
    }
  }
}

void SfcLoweringContext::index_names() {
  for (std::size_t i = 0; i < chart().steps.size(); ++i)
    step_index_.try_emplace(graphic::upper(chart().steps[i].name), i);
  for (std::size_t i = 0; i < chart().actions.size(); ++i)
    action_index_.try_emplace(graphic::upper(chart().actions[i].name), i);
}

void SfcLoweringContext::reserve_names() {
  names_.insert(pou_.name);
  for (const graphic::Variable& variable : pou_.variables) names_.insert(variable.name);
  for (const graphic::Step& step : chart().steps) names_.insert(step.name);
  for (const graphic::Transition& transition : chart().transitions) names_.insert(transition.name);
  for (const graphic::Action& action : chart().actions) names_.insert(action.name);
  // A text may use globals and functions that this POU does not declare.
  for_each_text([&](const std::string& text) {
    for_each_identifier(reader_, text, [&](std::string_view name) { names_.insert(name); });
  });
}

void SfcLoweringContext::declare_steps() {
  std::vector<bool> timed(chart().steps.size(), false);
  for_each_text([&](const std::string& text) {
    replace_flags(reader_, text, [&](std::string_view name, char flag) {
      const auto step = flag == 'T' ? step_index_.find(graphic::upper(name)) : step_index_.end();
      if (step != step_index_.end()) timed[step->second] = true;
      return std::string();
    });
  });
  if (std::find(timed.begin(), timed.end(), true) != timed.end()) {
    clock_timer_ = declare("SFC_CLOCK", "TON", "time since the first scan");
    now_ = declare("SFC_NOW", "TIME", "time since the first scan");
  }
  for (std::size_t i = 0; i < chart().steps.size(); ++i) {
    const graphic::Step& step = chart().steps[i];
    StepVariables variables;
    variables.active = declare(step.name + "_X", "BOOL", "step " + step.name + " is active");
    if (timed[i]) {
      variables.elapsed = declare(step.name + "_T", "TIME", "time since step " + step.name + " was entered");
      variables.entered_at = declare(step.name + "_SINCE", "TIME", "when step " + step.name + " was entered");
    }
    if (has_edge_action(step)) {
      variables.was_active = declare(step.name + "_WAS", "BOOL", "step " + step.name + " was active before");
    }
    pou_.step_variables.push_back(variables.active);
    steps_.push_back(std::move(variables));
  }
}

void SfcLoweringContext::declare_transitions() {
  for (std::size_t i = 0; i < chart().transitions.size(); ++i) {
    const std::string& name = chart().transitions[i].name;
    const std::string base = name.empty() ? "TRANS" + std::to_string(i) : name;
    pou_.transition_variables.push_back(declare(base + "_FIRES", "BOOL", "transition " + base + " fires"));
  }
}

// With final scan every action that a step uses has its flags, otherwise one whose flags are read.
void SfcLoweringContext::declare_actions() {
  std::vector<bool> read(chart().actions.size(), false);
  const auto mark = [&](std::string_view name) {
    if (const auto action = action_index_.find(graphic::upper(name)); action != action_index_.end())
      read[action->second] = true;
  };
  for_each_text([&](const std::string& text) {
    replace_flags(reader_, text, [&](std::string_view name, char flag) {
      if (flag == 'Q' || flag == 'A') mark(name);
      return std::string();
    });
  });
  for (const graphic::Step& step : chart().steps) {
    for (const ActionBlock& block : step.actions) {
      if (chart().final_scan) mark(block.target);
    }
  }
  for (std::size_t i = 0; i < read.size(); ++i) {
    ActionVariables variables;
    const std::string& name = chart().actions[i].name;
    if (read[i]) {
      variables.flag = declare(name + "_Q", "BOOL", "action " + name + " is active");
      variables.activation = variables.flag;
    }
    if (read[i] && chart().final_scan) {
      variables.activation = declare(name + "_A", "BOOL", "action " + name + " runs");
      variables.was_active = declare(name + "_WAS", "BOOL", "action " + name + " was active before");
    }
    actions_.push_back(std::move(variables));
  }
}

std::string SfcLoweringContext::declare(std::string_view wanted, std::string type, std::string comment,
                                        std::string initial) {
  graphic::Variable variable;
  variable.name = names_.unique(wanted);
  variable.type = std::move(type);
  variable.comment = std::move(comment);
  variable.initial = std::move(initial);
  pou_.variables.push_back(variable);
  return variable.name;
}

Condition SfcLoweringContext::active(graphic::StepId step, bool negated) const {
  return graphic::contact(steps_[step.value].active, negated);
}

Condition SfcLoweringContext::fires(std::size_t transition, bool negated) const {
  return graphic::contact(pou_.transition_variables[transition], negated);
}

// The variable behind `owner.flag`; empty where it is no flag of this chart.
std::string SfcLoweringContext::variable_of(std::string_view owner, char flag) const {
  const std::string folded = graphic::upper(owner);
  if (const auto step = step_index_.find(folded); step != step_index_.end()) {
    const StepVariables& variables = steps_[step->second];
    return flag == 'X' ? variables.active : flag == 'T' ? variables.elapsed : std::string();
  }
  if (const auto action = action_index_.find(folded); action != action_index_.end()) {
    const ActionVariables& variables = actions_[action->second];
    return flag == 'Q' ? variables.flag : flag == 'A' ? variables.activation : std::string();
  }
  return {};
}

std::string SfcLoweringContext::rewrite(std::string_view text) const {
  return replace_flags(reader_, text,
                       [this](std::string_view owner, char flag) { return variable_of(owner, flag); });
}

Condition SfcLoweringContext::rewrite(Condition condition) const {
  condition.name = rewrite(std::string_view(condition.name));
  condition.operand = rewrite(std::string_view(condition.operand));
  for (Condition& child : condition.children) child = rewrite(std::move(child));
  return condition;
}

void SfcLoweringContext::add_networks() {
  for (graphic::Rung& rung : networks_.every_scan.rungs) {
    rung.condition = rewrite(std::move(rung.condition));
    for (graphic::Block& block : rung.blocks) {
      for (auto& [pin, value] : block.inputs) value = rewrite(std::string_view(value));
      block.st_body = rewrite(std::string_view(block.st_body));
    }
    add(std::move(rung));
  }
  networks_.every_scan.rungs.clear();
}

graphic::Pou SfcLoweringContext::finish() {
  pou_.body = graphic::LadderProgram{std::move(rungs_), std::move(networks_.every_scan.wires)};
  return std::move(pou_);
}

graphic::Rung statements(std::string comment, graphic::Condition condition, std::string st) {
  graphic::Rung rung;
  rung.comment = std::move(comment);
  rung.condition = std::move(condition);
  graphic::Block block;
  block.st_body = std::move(st);
  rung.blocks.push_back(std::move(block));
  return rung;
}

}  // namespace stepwright::lowering

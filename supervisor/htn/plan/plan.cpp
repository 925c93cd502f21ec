#include "supervisor/htn/plan/plan.h"

namespace stepwright::htn {
namespace {

std::string words(const PlanNode& node) {
  std::string text = node.name;
  for (const std::string& argument : node.arguments) text += " " + argument;
  return text;
}

}  // namespace

std::string to_string(const PlanNode& node) {
  return "(" + words(node) + ")";
}

model::Plan actions_of(const Plan& plan) {
  model::Plan actions;
  for (const std::size_t step : plan.steps)
    actions.actions.push_back({plan.nodes[step].name, plan.nodes[step].arguments});
  actions.cost = plan.cost;
  return actions;
}

std::string print_plan(const Plan& plan) {
  std::string text = "==>\n";
  for (const std::size_t step : plan.steps)
    text += std::to_string(step) + " " + words(plan.nodes[step]) + "\n";
  text += "root";
  for (const std::size_t root : plan.roots) text += " " + std::to_string(root);
  text += "\n";
  for (std::size_t i = 0; i < plan.nodes.size(); ++i) {
    const PlanNode& node = plan.nodes[i];
    if (node.method.empty()) continue;
    text += std::to_string(i) + " " + words(node) + " -> " + node.method;
    for (const std::size_t child : node.children) text += " " + std::to_string(child);
    text += "\n";
  }
  return text + "<==\n";
}

}  // namespace stepwright::htn

#include "supervisor/htn/plan/plan_json.h"

#include <nlohmann/json.hpp>

namespace stepwright::htn {

// Decompositions may be as deep as a plan is long, which nested JSON must not be: nodes name their children.
nlohmann::json to_json(const Plan& plan) {
  nlohmann::json actions = nlohmann::json::array(), tree = nlohmann::json::array();
  for (const std::size_t step : plan.steps) actions.push_back(to_string(plan.nodes[step]));
  for (const PlanNode& node : plan.nodes) {
    nlohmann::json each = {{"task", to_string(node)}};
    if (!node.method.empty()) {
      each["method"] = node.method;
      each["binding"] = node.binding;
      each["subtasks"] = node.children;
    }
    tree.push_back(std::move(each));
  }
  return {{"plan", std::move(actions)},
          {"plan_steps", plan.steps.size()},
          {"plan_cost", plan.cost},
          {"tree", {{"roots", plan.roots}, {"nodes", std::move(tree)}}}};
}

}  // namespace stepwright::htn

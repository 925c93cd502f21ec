#pragma once

// A plan of a hierarchical task: its actions in order, and the decomposition that they come from.
//
// Thread rule: plain values. Names are those of the files, in lower case; a number is an index into `nodes`,
// whose order is that of a walk through the tree from the left.
//
//   for (std::size_t node : plan.steps) puts(to_string(plan.nodes[node]).c_str());    // "(pick left cup1)"

#include <cstddef>
#include <string>
#include <vector>

#include "supervisor/model/plan.h"

namespace stepwright::htn {

struct PlanNode {
  std::string name;  // of a task or an action
  std::vector<std::string> arguments;
  std::string method;                 // empty: an action
  std::vector<std::string> binding;   // the objects of the method's parameters
  std::vector<std::size_t> children;  // in the order in which they are done
};

struct Plan {
  std::vector<PlanNode> nodes;
  std::vector<std::string> binding;  // the objects of the parameters of the problem's ":htn"
  std::vector<std::size_t> roots;    // the problem's tasks
  std::vector<std::size_t> steps;    // the actions
  double cost = 0.0;                 // what they add to total-cost
};

// "(pick left cup1)"
std::string to_string(const PlanNode& node);

// The steps as every planner's plan has them; its cost is the plan's, its bound 0.
model::Plan actions_of(const Plan& plan);

// The form in which planners of the International Planning Competition 2020 write plans of hierarchical
// tasks: "==>", numbered actions, "root", numbered decompositions, "<==".
std::string print_plan(const Plan& plan);

}  // namespace stepwright::htn

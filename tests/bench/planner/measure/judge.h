#pragma once

// The validator's word on a plan.
//
// Thread rule: pure functions.

#include <string>
#include <vector>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"

namespace stepwright::bench {

struct Judgement {
  std::string wrong;  // empty: the plan is valid
  double cost = 0.0;
};

Judgement judge(const pddl::Task& task, std::vector<model::GroundAction> actions);

// "(load v1 f1 level8)" or the same without parentheses.
model::GroundAction action_of(const std::string& text);

}  // namespace stepwright::bench

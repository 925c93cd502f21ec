#pragma once

// The picture of `stepwright plan --svg FILE [--binding B.toml]`: schedule and causal graph. Without a
// binding every action takes one step.

#include <string>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/task.h"

namespace stepwright::plan {

struct PictureArguments {
  std::string svg_file;  // empty: none
  std::string binding_file;
};

// False with the diagnostics printed. True at once without a file.
bool draw_plan(const pddl::Task& task, const model::Plan& plan, const PictureArguments& arguments);

}  // namespace stepwright::plan

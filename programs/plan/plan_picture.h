#pragma once

// The picture of `stepwright plan --svg FILE [--binding B.toml]`: schedule and causal graph. Without a
// binding every action takes one step.

#include <optional>
#include <string>
#include <utility>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"
#include "supervisor/translate/binding.h"

namespace stepwright::plan {

struct PictureArguments {
  std::string svg_file;  // empty: none
  std::string binding_file;
};

class PlanPicture {
 public:
  // Reads the binding. Nothing, with the diagnostics printed, if that fails.
  static std::optional<PlanPicture> prepare(const pddl::Task& task, const PictureArguments& arguments);

  // False with the diagnostics printed. True at once without a file.
  bool draw(const pddl::Task& task, const model::Plan& plan) const;

 private:
  explicit PlanPicture(std::string svg_file) : svg_file_(std::move(svg_file)) {}

  std::string svg_file_;
  std::optional<translate::Binding> binding_;
};

}  // namespace stepwright::plan

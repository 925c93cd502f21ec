#pragma once

// Looks at a plan once more with means of the benchmark's own, beside planner and plan checker: the controls
// are driven in steps of a millisecond by the rule of Runge and Kutta, the word is read from samples of the
// way a quarter of a millimetre apart, the formula is evaluated on it operator by operator as it was written,
// and links are compared with outlines every 5 ms.
//
// A pure function; any thread. Example:
//   const PlanCheck check = check_plan(problem, *formula, answer->plan);
//   violations += check.word_holds ? 0 : 1;

#include <vector>

#include "supervisor/ltl/scene/scene.h"
#include "supervisor/ltl/syntax/formula.h"
#include "supervisor/ltl/train/train_plan.h"

namespace stepwright::bench {

struct PlanCheck {
  bool word_holds = false;  // the word satisfies the formula by itself
  bool clear = true;        // no link meets an outline, or a link that is no neighbour
  std::vector<ltl::Label> word;
  double length_m = 0.0;
};

// Requires a formula without G, R and W, and negations of names only.
PlanCheck check_plan(const ltl::Problem& problem, const ltl::Formula& formula, const ltl::TrainPlan& plan);

// The definition of each operator on a word that ends: X, F and U ask for letters that are there.
bool holds_on(const ltl::Formula& formula, const std::vector<ltl::Label>& word);

}  // namespace stepwright::bench

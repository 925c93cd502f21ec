#pragma once

// E. Plaku, Planning Robot Motions to Satisfy Linear Temporal Logic, Geometric, and Differential Constraints
// (2012), Algorithm 1 as it is printed, on what ours plans on: the same triangles, automaton, motion and
// walls. A baseline; nothing of our search is in it. What the paper leaves open is chosen as follows.
//
// - The root has read the label where the train stands: delta(z_init, DISCRETESTATE(s_init)). (Printed:
// none.)
// - delta(z) goes by the labels that the floor has, instead of all 2^n letters, of which most never come.
// - delta(z_from) - Gamma is often empty: then z_to is any of delta(z_from) but z_from itself; if that is
//   empty, too, there is no target, and another z_from is drawn.
// - Where no plan leads to z_to, <z_from, r_from> alone is active.
// - The distance from region to region is that of their centroids.
// - "Several steps": a number from 1 to `steps` by chance, each the integrator's own step of at most `step_s`
//   and 10 cm, with its state as a vertex, as printed; the control is uniform within its limits.
// - z reads the labels of the straight way between two states, each once, so that no strip is jumped over.
// - Links are 5 cm longer and wider against what happens between two states, as ours are. A trajectory that
//   the plan checker does not accept does not end the search: its last vertex is left out.
//
// One thread at a time. Example:
//   const PaperAnswer answer = plan_by_paper(problem, {.seed = 1, .most_s = 10.0});

#include <cstdint>
#include <optional>

#include "supervisor/ltl/checker/plan_checker.h"
#include "supervisor/ltl/scene/scene.h"

namespace stepwright::bench {

struct PaperOptions {
  std::size_t iterations = 200;  // for each discrete target (Algorithm 1, line 10): the paper has 200
  double shortest = 0.9;         // p: the share of discrete plans that are shortest ones; not in the paper
  std::size_t steps = 20;        // line 14, at most; not in the paper
  double step_s = 0.1;           // line 15, at most
  std::uint64_t seed = 1;
  double most_s = 10.0;
};

struct PaperAnswer {
  std::optional<ltl::TrainPlan> plan;  // accepted by the plan checker
  ltl::PlanJudgement judgement;
  std::size_t vertices = 0;
  std::size_t targets = 0;  // rounds of the outer loop
  std::size_t refused = 0;  // trajectories that the plan checker did not accept
  double spent_s = 0.0;     // triangles, automaton, search and plan checker
};

// Requires a task that has an automaton; without one there is no plan.
PaperAnswer plan_by_paper(const ltl::Problem& problem, const PaperOptions& options);

}  // namespace stepwright::bench

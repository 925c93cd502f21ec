#pragma once

// Judges a plan by other means than it was made with: the controls are integrated by CVODE, the states in
// between are looked at every few millimetres, boxes are compared with every outline, the labels of the way
// become a word, and the formula is evaluated on that word by its definition, without automata.
//
// Pure functions; any thread. Example:
//   const PlanJudgement judgement = judge_plan(floor, model, start, formula, plan);
//   if (!judgement.accepted()) std::puts(judgement.reason.c_str());

#include <functional>
#include <string>
#include <vector>

#include "supervisor/ltl/automaton/verdict.h"
#include "supervisor/ltl/regions/make_regions.h"
#include "supervisor/ltl/syntax/formula.h"
#include "supervisor/ltl/train/train_plan.h"

namespace stepwright::ltl {

struct PlanCheckerOptions {
  double relative_tolerance = 1e-10;
  double look_every_m = 0.01;    // on the way of the car at its most speed
  double most_end_error = 1e-3;  // of each state: m, rad, m/s
  double longest_s = 86'400.0;
  std::vector<Label> read = {};  // before the plan, of a run that goes on
  std::function<bool()> stop{};  // asked now and then: whether there is no time left to judge it
};

struct PlanJudgement {
  std::string reason;  // empty: the plan holds
  double end_error = 0.0;
  double length_m = 0.0;  // of the car's way
  double duration_s = 0.0;
  std::vector<Label> word;  // labels of the car's reference point, each one other than the one before
  std::size_t looks = 0;

  bool accepted() const { return reason.empty(); }
};

// `start` is where the train stands: the plan must begin there.
PlanJudgement judge_plan(const Floor& floor, const TrainModel& model, const TrainState& start,
                         const Formula& formula, const TrainPlan& plan,
                         const PlanCheckerOptions& options = {});

// The labels of a straight way, each one other than the one before, appended to a word. A strip is read
// however thin it is.
void read_way(const std::vector<Area>& propositions, geometry::Point from, geometry::Point to,
              std::vector<Label>& word);

// Whether the word satisfies the formula by itself, by the definition of each operator on finite words
// (strong: X and U ask for letters that are there). Requires a formula without Release where it is to be
// exact for co-safe tasks; R holds to the end of the word.
bool satisfies(const Formula& formula, const std::vector<Letter>& word);

}  // namespace stepwright::ltl

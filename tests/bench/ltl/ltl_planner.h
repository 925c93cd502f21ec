#pragma once

// OMPL's LTLPlanner (A. Bhatia, M. Maly, L. Kavraki, M. Vardi, Motion Planning with Complex Goals, IEEE
// Robotics & Automation Magazine 18(3), 2011) on what ours plans on: the same triangles, automaton, motion
// and walls. Its plan is judged by the same plan checker.
//
// OMPL's headers stay in ltl_planner.cpp. One thread at a time; OMPL's dice have one seed for a process
// (seed_ompl, before anything else of it). Example:
//   seed_ompl(1);
//   const OmplAnswer answer = plan_by_ltlplanner(problem, 0.1, 10.0);

#include <cstdint>
#include <optional>

#include "supervisor/ltl/checker/plan_checker.h"
#include "supervisor/ltl/scene/scene.h"

namespace stepwright::bench {

void seed_ompl(std::uint32_t seed);

struct OmplAnswer {
  std::optional<ltl::TrainPlan> plan;  // that OMPL calls a solution
  ltl::PlanJudgement judgement;        // of that
  double spent_s = 0.0;                // triangles, automaton, search and plan checker
};

// `explore_s`: how long it explores along each lead, its main setting. Requires a task that has an automaton.
OmplAnswer plan_by_ltlplanner(const ltl::Problem& problem, double explore_s, double most_s);

}  // namespace stepwright::bench

#include "supervisor/motion/problem/arm_checkers.h"

#include <utility>

namespace stepwright::motion {

FalsePairs pairs_of(const ArmModel& model, const ArmProblem& problem) {
  return false_pairs(model.robot, model.bodies, model.spheres, problem.known_pairs(), problem.coordinates,
                     problem.rest);
}

result::Result<ArmCheckers> ArmCheckers::make(const ArmModel& model, const ArmProblem& problem,
                                              const FalsePairs& pairs) {
  ArmCheckers made;
  auto all = CollisionChecker::make(model.robot, model.spheres, problem.known_pairs(), problem.world,
                                    problem.coordinates, problem.rest, problem.attached);
  if (!all) return result::forward(all);
  made.all_ = std::move(*all);
  if (pairs.pairs.empty()) return made;
  auto lean = CollisionChecker::make(model.robot, model.spheres, &pairs.for_spheres, problem.world,
                                     problem.coordinates, problem.rest, problem.attached);
  if (!lean) return result::forward(lean);
  made.lean_ = std::move(*lean);
  auto exact = ExactChecker::make(model.robot, pairs.bodies, &pairs.only_pairs, {}, problem.coordinates,
                                  problem.rest, &model.spheres);
  if (!exact) return result::forward(exact);
  made.pairs_ = std::move(*exact);
  return made;
}

}  // namespace stepwright::motion

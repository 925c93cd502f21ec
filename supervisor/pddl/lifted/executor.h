#pragma once

// Executes ground actions on the schemas: the ground truth that plans are judged by.
//
// Thread rule: one execution, one object. A step that fails leaves the state as it was.
//
//   Executor executor(definition, initial_state(definition));
//   if (auto failure = executor.step({"move", {"v1", "f1", "a1"}})) ...

#include <optional>
#include <string>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/lifted/evaluate.h"

namespace stepwright::pddl {

struct Failure {
  std::string code;     // P03xx
  std::string message;  // one sentence
  std::string hint;
  Violation violation;  // of a precondition
};

struct BoundAction {
  const Action* action = nullptr;
  Binding binding;
};

// Finds the schema and the objects of an action, checking number and types. On failure sets `failure`.
std::optional<BoundAction> bind(const Definition& definition, const model::GroundAction& action,
                                Failure& failure);

class Executor {
 public:
  Executor(const Definition& definition, LiftedState state)
      : definition_(definition), state_(std::move(state)) {}

  std::optional<Failure> step(const model::GroundAction& action);

  const LiftedState& state() const { return state_; }

  // The value of the metric now; the number of steps without one.
  std::optional<double> cost() const;

 private:
  const Definition& definition_;
  LiftedState state_;
  std::size_t steps_ = 0;
};

}  // namespace stepwright::pddl

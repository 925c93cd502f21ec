#pragma once

// Plans, budgets and outcomes: the vocabulary that every planner speaks.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stepwright::model {

// A ground action as PDDL writes it: (name argument ...). Names are lower case.
struct GroundAction {
  std::string name;
  std::vector<std::string> arguments;

  friend bool operator==(const GroundAction&, const GroundAction&) = default;
};

// "(load v1 f1 level8)"
std::string to_string(const GroundAction& action);

// "a happens before b", both indices into Plan::actions.
struct Ordering {
  std::size_t before = 0;
  std::size_t after = 0;

  friend bool operator==(const Ordering&, const Ordering&) = default;
};

struct Plan {
  std::vector<GroundAction> actions;  // in an order in which they can be executed
  // A partial order that suffices (empty: any order does); nothing = only the list's order is known good.
  std::optional<std::vector<Ordering>> orderings;
  double cost = 0.0;            // value of the metric after the plan; number of actions without a metric
  double bound = 0.0;           // no plan can cost less
  bool proved_optimal = false;  // cost == bound, and no plan of that cost is shorter
};

// Limits of a planner's time and memory. Zero = no limit.
struct Budget {
  std::chrono::milliseconds time{0};
  std::size_t memory_mb = 0;
  std::uint64_t states = 0;  // that a search may expand: the same end on every machine
};

enum class OutcomeKind : std::uint8_t {
  Solved,       // a plan; optimal if the plan says so
  Approximate,  // a plan that reaches the goal within a stated tolerance only
  Infeasible,   // proved: there is no plan
  Exhausted,    // the budget ended first; `plan` holds the best one, if any
  Cancelled,
};

struct Outcome {
  OutcomeKind kind = OutcomeKind::Exhausted;
  std::optional<Plan> plan;
  std::string reason;  // Infeasible: which goal cannot be reached, and why
  // Figures of the search.
  double first_plan_ms = 0.0;
  double wall_ms = 0.0;
  std::uint64_t expanded = 0;
  double peak_mb = 0.0;
};

}  // namespace stepwright::model

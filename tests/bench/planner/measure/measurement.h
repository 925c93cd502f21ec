#pragma once

// Measurement of one planner with one instance, and the runs that make it. Every planner works in a process
// of its own; every plan is judged by the validator here, in the bench's process.
//
// Times are wall times from the first byte of the texts: reading, grounding and search count; CPU times are
// beside them, as a busy machine distorts the others.
//
// Thread rule: plain values; the functions fork, so one thread only.

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/model/plan.h"
#include "supervisor/pddl/task/task.h"
#include "tests/bench/planner/generators/instance.h"

namespace stepwright::bench {

struct Limits {
  std::chrono::milliseconds time{2000};
  std::size_t memory_mb = 4096;
  bool first_only = false;
};

// A plan and when it was found.
struct Found {
  double wall_ms = 0.0;
  double cpu_ms = 0.0;
  double cost = 0.0;  // as the validator counts it
  std::size_t steps = 0;
};

struct Measurement {
  std::string outcome;  // "optimal", "plan", "none" or why there is nothing
  std::vector<Found> profile;
  std::optional<double> bound;  // no plan can cost less
  bool proved = false;
  double wall_ms = 0.0;
  double cpu_ms = 0.0;
  double peak_mb = 0.0;
  std::uint64_t expanded = 0;
  std::string wrong;  // not empty: a plan did not pass validation, and why

  bool solved() const { return !profile.empty(); }
  const Found& first() const { return profile.front(); }
  const Found& last() const { return profile.back(); }
};

// Result of the planner's own grounding of an instance; no operators: it did not end in time.
struct GroundSize {
  double grounding_ms = 0.0;
  std::size_t operators = 0, facts = 0, variables = 0;
};

// Ours: first plan, improvements, bound.
Measurement measure_planner(const Instance& instance, const pddl::Task& task, const Limits& limits);

GroundSize measure_grounding(const Instance& instance, const Limits& limits);

// The textbook planner of baseline/.
Measurement measure_baseline(const Instance& instance, const pddl::Task& task, const Limits& limits);

// Validates the output of a planner's process: one JSON object a line, with `plan` for every plan found and
// `expanded` in the last one.
struct ChildResult;
Measurement measurement_of(const ChildResult& child, const pddl::Task& task);

// A planner that stands outside, found at run time. In the command {domain}, {problem} and {plan} are files;
// the plan file is in the format of VAL.
struct Outside {
  std::string name;
  std::string command;
  bool classical_only = false;
};
Measurement measure_outside(const Outside& planner, const Instance& instance, const pddl::Task& task,
                            const Limits& limits);

}  // namespace stepwright::bench

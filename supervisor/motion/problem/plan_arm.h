#pragma once

// Plans a problem by the name of a planner, ours or one of OMPL, and has every motion of the path judged by
// the bodies themselves.
//
//   const auto answer = plan_arm(*model, *problem, {.planner = "BITstar", .seed = 1, .seconds = 5});
//   if (answer->path.empty()) std::cout << answer->cause;
//
// A function without state but for OMPL's source of random numbers (ompl_planner.h). Ours has the same path
// for a seed wherever the time is enough: what ends its rounds is counted, and the clock is read between
// them.

#include <atomic>
#include <string>

#include "supervisor/motion/path/certain_path.h"
#include "supervisor/motion/problem/arm_problem.h"

namespace stepwright::motion {

inline constexpr const char* kOwnPlanner = "stepwright";

struct ArmOptions {
  std::string planner = kOwnPlanner;
  std::uint64_t seed = 1;
  double seconds = 10.0;
  double step = 0.02;  // rad or m, between places that are checked
  const std::atomic<bool>* cancel = nullptr;
};

struct ArmAnswer {
  enum class Ending : std::uint8_t {
    Found,
    Impossible,  // an end collides or lies beyond a limit
    GivenUp,     // time or tries ended
  };
  Ending ending = Ending::GivenUp;
  std::string cause;  // in words, unless found
  JointPath path;     // every motion of it is free by the bodies as a whole
  double length = 0.0;
  CertainPath::Means means = CertainPath::Means::BySpheres;  // WaysOut: only of ours
  std::size_t rounds = 0, refused = 0;         // plans that were made, and those that the bodies refused
  double planning_ms = 0.0, recheck_ms = 0.0;  // of the clock
  result::Diagnostics notes;                   // warnings: pairs of links that spheres cannot judge
};

// Fails with A0301, A0302 and A0701.
[[nodiscard]] result::Result<ArmAnswer> plan_arm(const ArmModel& model, const ArmProblem& problem,
                                                 const ArmOptions& options = {});

}  // namespace stepwright::motion

#pragma once

// The geometric planners of OMPL (BSD-3-Clause, Sucan, Moll, Kavraki 2012, The Open Motion Planning Library),
// by their names, on our checkers.
//
//   const auto answer = plan_by_ompl("BITstar", by_spheres(*checker), space, from, {goal}, {.seed = 3});
//   if (!answer) std::cerr << to_string(answer.error());       // A0701: there is no such planner
//
// One call at a time in a process: OMPL's random numbers have one source, and calls wait for each other. The
// same seed gives the same path where `repeatable` says so and no clock ended the search; the others have
// threads of their own. Planners that go on to shorten a path do so until their time or their motions end.

#include <string>
#include <string_view>
#include <vector>

#include "supervisor/motion/path/plan_path.h"

namespace stepwright::motion {

namespace code {
inline constexpr const char* kNoPlanner = "A0701";      // no planner of that name
inline constexpr const char* kPlannerFailed = "A0702";  // OMPL refused the problem, with its words
}  // namespace code

struct OmplPlannerName {
  const char* name;
  bool repeatable;  // a seed has one answer
  bool goes_on;     // has a path and looks for shorter ones until it is stopped
};
const std::vector<OmplPlannerName>& ompl_planners();
// Null where there is none.
const OmplPlannerName* ompl_planner(std::string_view name);
// A0701 with the nearest name and the list of all.
result::Diagnostics no_such_planner(std::string_view name, std::vector<std::string> others = {});

struct OmplOptions {
  std::uint64_t seed = 1;
  double seconds = 5.0;                   // of the clock
  std::size_t most_checks = 100'000'000;  // of places and motions
  double range = 0.0;                     // longest step, for planners that have one; 0: as OMPL chooses
  double step = 0.02;                     // between places that are checked, in each coordinate
  // Motions by our checker, many places at once; else by OMPL, one place after the other.
  bool whole_motions = true;
  double* solve_ms = nullptr;  // if given: of the processor, OMPL's own search without what was set up for it
};

// Fails with A0701 and A0702. The path is OMPL's own, not shortened.
[[nodiscard]] result::Result<PathAnswer> plan_by_ompl(std::string_view planner, const FreeSpace& free,
                                                      const JointSpace& space, const Configuration& from,
                                                      const std::vector<Configuration>& goals,
                                                      const OmplOptions& options = {});

}  // namespace stepwright::motion

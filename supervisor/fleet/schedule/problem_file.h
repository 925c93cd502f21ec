#pragma once

// Scheduling problems as JSON: envelopes, bounds in milliseconds, named constraints
// (supervisor/doc/fleet_scheduling.md).
//
// Pure functions; any thread. What is read is sound: names differ, polygons are convex and overlap the next
// one, bounds are not negative and not turned round, constraints name what is there. Whether there is a
// schedule is for the scheduler to say.
//
//   auto problem = read_problem(text, "night_shift.json");
//   // night_shift.json:7:5: F0603: vehicles[2].polygons[0] ...
//   if (!problem) print(to_string(problem.error()));

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/schedule/problem.h"

namespace stepwright::fleet {

struct SchedulingProblem {
  std::vector<TrajectoryEnvelope> envelopes;
  std::vector<TemporalConstraint> constraints;
};

// Codes: F0601 no JSON (with line and column), F0602 wrong shape, F0603 wrong polygon, F0604 wrong bounds,
// F0605 a name that is unknown or used twice. The first problem found is reported.
[[nodiscard]] result::Result<SchedulingProblem> read_problem(std::string_view text, const std::string& file);

// What is wrong at a key of a document.
struct KeyProblem {
  std::string code;
  std::string key;
  std::string what;
  std::string hint;
};

// The `polygons` of a vehicle in another document, in which they stand at `key`. Codes as above, never F0601.
[[nodiscard]] tl::expected<std::vector<EnvelopePolygon>, KeyProblem> read_polygons(
    const nlohmann::json& polygons, const std::string& key);

// Text that read_problem reads back as the same problem.
std::string write_problem(const SchedulingProblem& problem);

}  // namespace stepwright::fleet

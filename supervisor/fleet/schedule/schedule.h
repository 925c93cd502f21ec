#pragma once

// Trajectory scheduling (Pecora and Cirillo 2012, "Trajectory Scheduling"): precedences between vehicles that
// keep them out of each other's way, or the proof that there are none and why.
//
// Spatial overlaps are found once, through a grid; overlaps that must be ordered alike are one critical
// section (sections.h); the first descent of the search is greedy, and what fails is learned
// (internal/search.h). The decision problem of both modes: is there an order of every pair of polygons that
// overlap in space, such that all constraints hold together? For Mode::EarliestTimes this is the paper's
// question, since the earliest times of a network are a solution of it: times without an overlap order every
// pair, and constraints that order every pair have earliest times without an overlap. So the search is
// complete for both.
//
// A pure function of its arguments but for the limits; any thread.
//
//   const Schedule made = schedule(envelopes, constraints, {.mode = Mode::Strict, .time = 1s});
//   if (made.verdict == Verdict::Scheduled) drive(made.earliest);
//   if (made.verdict == Verdict::Infeasible) print(to_string(made.core, envelopes, constraints));

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "supervisor/fleet/schedule/problem.h"
#include "supervisor/fleet/schedule/sections.h"

namespace stepwright::fleet {

enum class Verdict : std::uint8_t {
  Scheduled,
  Infeasible,  // proved
  Exhausted,   // the budget ended before either
  Cancelled,
};

// The exit of `first` comes no later than the entry of `second`.
struct Precedence {
  PolygonRef first;
  PolygonRef second;

  friend auto operator<=>(const Precedence&, const Precedence&) = default;
};

struct PolygonTimes {
  std::chrono::milliseconds entry{0};
  std::chrono::milliseconds exit{0};

  friend bool operator==(const PolygonTimes&, const PolygonTimes&) = default;
};
using VehicleTimes = std::vector<PolygonTimes>;

// Why there is no schedule: these together leave none. If minimal, without any one of the sections, the
// constraints or the slowest motions named here there would be one.
struct Core {
  std::vector<std::uint32_t> vehicles;
  std::vector<std::vector<SpatialPair>> sections;  // overlaps that must be ordered
  std::vector<std::uint32_t> constraints;          // indices of temporal constraints
  std::vector<std::uint32_t> slowest;              // vehicles that may not drive slower
  bool minimal = false;                            // false: the budget ended while it was made smaller
};

struct ScheduleFigures {
  std::size_t polygons = 0;
  std::size_t spatial_pairs = 0;
  std::size_t sections = 0;
  std::uint64_t decisions = 0;
  std::uint64_t conflicts = 0;          // of the search
  std::uint64_t explain_conflicts = 0;  // of the searches for the reason
  std::uint64_t restarts = 0;
  double geometry_ms = 0.0;  // overlaps and sections
  double search_ms = 0.0;    // to the first answer
  double improve_ms = 0.0;
  double times_ms = 0.0;  // precedences, earliest and latest times
  double explain_ms = 0.0;
};

struct Schedule {
  Verdict verdict = Verdict::Exhausted;
  // Pairs that overlap in space and time where every vehicle drives as early as it can: what the paper calls
  // conflicts at the root.
  std::vector<SpatialPair> conflicts;
  // Scheduled only:
  std::vector<Precedence> precedences;  // without those that follow from others of the same section
  std::vector<VehicleTimes> earliest;   // by vehicle and polygon
  std::vector<VehicleTimes> latest;
  // With an objective:
  std::chrono::milliseconds objective{0};
  std::chrono::milliseconds lower_bound{0};  // no schedule is better
  bool proved_optimal = false;
  // Infeasible and ScheduleOptions::explain only:
  Core core;
  ScheduleFigures figures;
};

// Envelopes have at least one polygon each and no negative bounds; constraints name polygons that are there.
Schedule schedule(std::span<const TrajectoryEnvelope> envelopes,
                  std::span<const TemporalConstraint> constraints, const ScheduleOptions& options);
// The same for one who knows which polygons overlap in space: `overlaps` is what overlapping_pairs would say.
Schedule schedule(std::span<const TrajectoryEnvelope> envelopes,
                  std::span<const TemporalConstraint> constraints, std::vector<SpatialPair> overlaps,
                  const ScheduleOptions& options);

// One sentence for each part of the reason.
std::string to_string(const Core& core, std::span<const TrajectoryEnvelope> envelopes,
                      std::span<const TemporalConstraint> constraints);

}  // namespace stepwright::fleet

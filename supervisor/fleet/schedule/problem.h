#pragma once

// Scheduling problem: trajectory envelopes, constraints between them, and the conditions that the answer must
// meet.
//
// Values; any thread may read.
//
//   TemporalConstraint{.name = "v1 within a minute", .from = {}, .to = {0, last, Side::Exit},
//                      .distance = {0ms, 60s}};

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/fleet/envelope/trajectory_envelope.h"

namespace stepwright::fleet {

enum class Side : std::uint8_t { Entry, Exit };

// Indices into the envelopes and the polygons of one of them.
struct PolygonRef {
  std::uint32_t vehicle = 0;
  std::uint32_t polygon = 0;

  friend auto operator<=>(const PolygonRef&, const PolygonRef&) = default;
};

struct TimepointRef {
  PolygonRef at;
  Side side = Side::Entry;

  friend auto operator<=>(const TimepointRef&, const TimepointRef&) = default;
};

// least <= t(to) - t(from) <= most; `from` nothing: time zero. Distances of the horizon (100,000 s) and
// above, either way, bind nothing; `least` may be negative.
struct TemporalConstraint {
  std::string name;  // what explanations call it
  std::optional<TimepointRef> from;
  TimepointRef to;
  Bounds distance;
};

enum class Mode : std::uint8_t {
  // As Pecora and Cirillo 2012: no two polygons that overlap in space overlap in time *in the earliest
  // times*.
  // A delay may bring overlaps back; a vehicle is nowhere before it starts and after it has arrived.
  EarliestTimes,
  // Every two polygons that overlap in space are ordered, whatever the times: a delay needs new times only.
  // A first polygon is occupied from time zero, a last one for ever.
  Strict,
};

enum class Objective : std::uint8_t {
  None,            // any schedule
  Makespan,        // the latest arrival is as early as can be
  TotalTardiness,  // the sum of how much later than due vehicles arrive
};

struct ScheduleOptions {
  Mode mode = Mode::Strict;
  Objective objective = Objective::None;
  std::vector<std::chrono::milliseconds> due = {};  // of each vehicle, for TotalTardiness
  std::chrono::milliseconds time{0};  // budget of search, improvement and explanation; zero = no limit
  // Budget of the search that does not depend on the machine, and once more of those that explain; zero = no
  // limit.
  std::uint64_t conflicts = 0;
  bool explain = true;                        // name the reason where there is no schedule
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

}  // namespace stepwright::fleet

#pragma once

// Judges times of vehicles without the scheduler: whether they keep what envelopes and constraints say, and
// whether two vehicles are ever in overlapping polygons at once. It compares all polygons with all others and
// reads nothing that the scheduler computed but the times. Pure functions.
//
//   for (const std::string& fault : faults_of(made.earliest, envelopes, constraints, mode)) ...

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "supervisor/fleet/schedule/schedule.h"

namespace stepwright::fleet {

// One sentence for each fault; empty if all is well. Parked vehicles count in Mode::Strict only.
std::vector<std::string> faults_of(const std::vector<VehicleTimes>& times,
                                   std::span<const TrajectoryEnvelope> envelopes,
                                   std::span<const TemporalConstraint> constraints, Mode mode);

// Times between earliest and latest that keep envelopes, constraints and precedences, drawn at random: each
// timepoint in a random order is set to a time that the rest still allows.
std::vector<VehicleTimes> random_times(const Schedule& made, std::span<const TrajectoryEnvelope> envelopes,
                                       std::span<const TemporalConstraint> constraints, std::uint64_t seed);

}  // namespace stepwright::fleet

#pragma once

// A schedule in execution: who is late makes others wait, without any search.
//
// Keeps the network of a schedule with its precedences. Each delay is one constraint, propagated to what it
// changes. With Mode::Strict every order of vehicles that meet is in the network, so that the new earliest
// times are free of collisions; with Mode::EarliestTimes they need not be. One thread at a time.
//
//   Retiming retiming(envelopes, constraints, made);
//   if (!retiming.not_before({{3, 5}, Side::Exit}, 81'200ms)) report(retiming.broken());
//   drive(retiming.earliest({{4, 0}, Side::Entry}));

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "supervisor/fleet/network/network.h"
#include "supervisor/fleet/schedule/motion.h"
#include "supervisor/fleet/schedule/schedule.h"

namespace stepwright::fleet {

class Retiming {
 public:
  // `made` is a schedule of these envelopes and constraints.
  Retiming(std::span<const TrajectoryEnvelope> envelopes, std::span<const TemporalConstraint> constraints,
           const Schedule& made);

  // From here on the timepoint is at `time` or later. False if that cannot be: nothing has changed then but
  // `broken`.
  [[nodiscard]] bool not_before(TimepointRef timepoint, std::chrono::milliseconds time);

  std::chrono::milliseconds earliest(TimepointRef timepoint) const;
  std::vector<VehicleTimes> earliest() const;

  // The constraints that the last refused delay contradicts.
  struct Broken {
    std::vector<std::uint32_t> constraints;  // indices of temporal constraints
    std::vector<std::uint32_t> slowest;      // vehicles that would have to drive slower than they may
    std::vector<Precedence> precedences;
  };
  Broken broken() const;

 private:
  Motion motion_;
  Network network_;
  std::vector<Precedence> precedences_;
};

}  // namespace stepwright::fleet

#include "supervisor/fleet/schedule/motion.h"

#include <algorithm>
#include <chrono>

namespace stepwright::fleet {

using std::chrono::milliseconds;

namespace {

constexpr milliseconds kInstant{1};

}  // namespace

Motion::Motion(std::span<const TrajectoryEnvelope> envelopes,
               std::span<const TemporalConstraint> constraints) {
  labels_.vehicles = static_cast<std::uint32_t>(envelopes.size());
  labels_.constraints = static_cast<std::uint32_t>(constraints.size());
  first_polygon_.push_back(0);
  for (const TrajectoryEnvelope& envelope : envelopes) {
    first_polygon_.push_back(first_polygon_.back() + static_cast<std::uint32_t>(envelope.polygons.size()));
  }
  timepoints_ = 1 + 2 * static_cast<std::size_t>(first_polygon_.back());
  constraints_.reserve(3 * timepoints_ + 2 * constraints.size());
  for (std::uint32_t v = 0; v < envelopes.size(); ++v) add_vehicle(v, envelopes[v]);
  for (std::uint32_t c = 0; c < constraints.size(); ++c) {
    const TemporalConstraint& constraint = constraints[c];
    const Timepoint from = constraint.from ? timepoint(constraint.from->at, constraint.from->side) : kOrigin;
    const Timepoint to = timepoint(constraint.to.at, constraint.to.side);
    at_least(from, to, constraint.distance.least, labels_.temporal(c));
    at_most(from, to, constraint.distance.most, labels_.temporal(c));
  }
}

PolygonRef Motion::polygon_of(Timepoint t) const {
  const std::uint32_t polygon = (t.value - 1) / 2;
  const auto after = std::ranges::upper_bound(first_polygon_, polygon);
  const auto vehicle = static_cast<std::uint32_t>(after - first_polygon_.begin() - 1);
  return {vehicle, polygon - first_polygon_[vehicle]};
}

void Motion::add_vehicle(std::uint32_t vehicle, const TrajectoryEnvelope& envelope) {
  const std::uint32_t fastest = labels_.fastest(vehicle);
  const std::uint32_t slowest = labels_.slowest(vehicle);
  for (std::uint32_t k = 0; k < envelope.polygons.size(); ++k) {
    const EnvelopePolygon& polygon = envelope.polygons[k];
    const Timepoint entry = timepoint({vehicle, k}, Side::Entry);
    const Timepoint exit = timepoint({vehicle, k}, Side::Exit);
    if (k > 0) {
      const EnvelopePolygon& before = envelope.polygons[k - 1];
      const Timepoint entry_before = timepoint({vehicle, k - 1}, Side::Entry);
      const Timepoint exit_before = timepoint({vehicle, k - 1}, Side::Exit);
      const milliseconds zero{0};
      at_least(entry_before, entry, std::max(zero, before.stay.least - before.overlap.least), fastest);
      at_least(exit_before, exit, std::max(zero, polygon.stay.least - before.overlap.least), fastest);
      at_least(entry, exit_before, before.overlap.least, fastest);
      at_most(entry, exit_before, before.overlap.most, slowest);
    }
    // A time between them, or two vehicles could be scheduled to change places at one instant.
    const auto last = static_cast<std::uint32_t>(envelope.polygons.size() - 1);
    const std::uint32_t into = std::min(last, k + polygon.left_into);
    if (into > k + 1) at_least(timepoint({vehicle, into}, Side::Entry), exit, kInstant, fastest);
    at_least(entry, exit, polygon.stay.least, fastest);
    at_most(entry, exit, polygon.stay.most, slowest);
  }
}

void Motion::at_least(Timepoint from, Timepoint to, milliseconds least, std::uint32_t label) {
  if (least.count() <= -kHorizon_ms) return;
  const auto ms = std::min<milliseconds::rep>(least.count(), kHorizon_ms + 1);
  constraints_.push_back({from, to, static_cast<std::int32_t>(ms), label});
}

void Motion::at_most(Timepoint from, Timepoint to, milliseconds most, std::uint32_t label) {
  if (most.count() >= kHorizon_ms) return;
  const auto ms = std::max<milliseconds::rep>(most.count(), -kHorizon_ms - 1);
  constraints_.push_back({to, from, static_cast<std::int32_t>(-ms), label});
}

}  // namespace stepwright::fleet

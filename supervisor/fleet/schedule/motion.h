#pragma once

// The times of vehicles as timepoints of a network, and what their envelopes say about them.
//
// Each polygon k of a vehicle has an entry s(k) and an exit e(k). Beside the sets D (stay) and O (overlap) of
// the paper, two lower bounds hold that follow from driving one path: a vehicle does not enter, and does not
// leave, the next polygon before it has driven from one border to the other,
//
//   s(k+1) - s(k) >= max(0, stay(k).least - overlap(k).least)
//   e(k+1) - e(k) >= max(0, stay(k+1).least - overlap(k).least)
//
// Without them a slow passage through the overlap would let the next polygon be entered before the first one:
// with the slow v_min of the paper all earliest entries would be time zero. Where a polygon is left only into
// one farther on (EnvelopePolygon::left_into), e(k) > s(k + left_into).
//
// Values; any thread may read.

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/network/constraint.h"
#include "supervisor/fleet/schedule/problem.h"

namespace stepwright::fleet {

// Labels of constraints in networks of schedules.
struct MotionLabels {
  std::uint32_t vehicles = 0;
  std::uint32_t constraints = 0;

  std::uint32_t fastest(std::uint32_t vehicle) const { return 2 * vehicle; }  // its lower bounds
  std::uint32_t slowest(std::uint32_t vehicle) const { return 2 * vehicle + 1; }
  std::uint32_t temporal(std::uint32_t constraint) const { return 2 * vehicles + constraint; }
  // Labels from here on are precedences.
  std::uint32_t precedences() const { return 2 * vehicles + constraints; }
};

class Motion {
 public:
  // Requires bounds that are not negative and constraints that name polygons of the envelopes.
  Motion(std::span<const TrajectoryEnvelope> envelopes, std::span<const TemporalConstraint> constraints);

  std::size_t timepoints() const { return timepoints_; }
  Timepoint timepoint(PolygonRef at, Side side) const {
    const std::uint32_t exit = side == Side::Exit ? 1 : 0;
    return Timepoint(1 + 2 * (first_polygon_[at.vehicle] + at.polygon) + exit);
  }
  // Of a timepoint other than the origin.
  PolygonRef polygon_of(Timepoint t) const;
  std::uint32_t polygons(std::uint32_t vehicle) const {
    return first_polygon_[vehicle + 1] - first_polygon_[vehicle];
  }
  std::uint32_t polygons() const { return first_polygon_.back(); }
  std::uint32_t vehicles() const { return static_cast<std::uint32_t>(first_polygon_.size() - 1); }
  bool last(PolygonRef at) const { return at.polygon + 1 == polygons(at.vehicle); }

  // Those of a vehicle follow those of the one before, those of temporal constraints follow all.
  const std::vector<Constraint>& constraints() const { return constraints_; }
  const MotionLabels& labels() const { return labels_; }

 private:
  void add_vehicle(std::uint32_t vehicle, const TrajectoryEnvelope& envelope);
  void at_least(Timepoint from, Timepoint to, std::chrono::milliseconds least, std::uint32_t label);
  void at_most(Timepoint from, Timepoint to, std::chrono::milliseconds most, std::uint32_t label);

  std::vector<std::uint32_t> first_polygon_;
  std::size_t timepoints_ = 1;
  MotionLabels labels_;
  std::vector<Constraint> constraints_;
};

}  // namespace stepwright::fleet

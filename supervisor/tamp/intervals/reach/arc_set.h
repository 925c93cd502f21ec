#pragma once

// Angles on the circle, and sets of disjoint arcs of it. An angle is a 32-bit number whose 2^32 values are a
// full turn: sums wrap around by themselves, the seam at +-pi is a place like any other, and sums,
// differences, unions and intersections of arcs are exact. A unit is 1.5e-9 rad.
//
// Values without heap; any thread. A set has room for kMost arcs; beyond that the two that are nearest to
// each other become one: a set may grow by that, it never loses an angle.
//
//   ArcSet wrist = ArcSet::of(arc_outward(-0.7, 2.36));
//   wrist = intersection_of(wrist.arcs(), difference_of(reach, grasp.arcs()).arcs());

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::tamp {

using Angle = std::uint32_t;  // in units; 2^32 are a full turn

// The nearest unit. Requires a finite number.
Angle angle_of(double rad);
// In [-pi, pi).
double radians_of(Angle angle);
// Signed, the short way from `from` to `to`: in [-pi, pi).
double turn_rad(Angle from, Angle to);

// From `low` anticlockwise over `width` units, both ends included.
struct Arc {
  static constexpr std::uint32_t kFull = 0xFFFFFFFFu;

  Angle low = 0;
  std::uint32_t width = 0;

  Angle high() const { return low + width; }
  bool contains(Angle angle) const { return angle - low <= width; }
  bool contains(Arc other) const {
    return static_cast<std::uint64_t>(other.low - low) + other.width <= width;
  }
  friend bool operator==(Arc, Arc) = default;
};

// The least arc of whole units that holds [low_rad, high_rad]. Requires low_rad <= high_rad.
Arc arc_outward(double low_rad, double high_rad);

class ArcSet {
 public:
  static constexpr std::size_t kMost = 8;

  static ArcSet full() { return of({0, Arc::kFull}); }
  static ArcSet of(Arc arc) {
    ArcSet set;
    set.arcs_[0] = arc;
    set.count_ = 1;
    return set;
  }
  static ArcSet point(Angle angle) { return of({angle, 0}); }

  bool empty() const { return count_ == 0; }
  bool is_full() const { return count_ == 1 && arcs_[0].width == Arc::kFull; }
  std::size_t size() const { return count_; }
  // In the order of their `low`, disjoint, with a gap between any two.
  std::span<const Arc> arcs() const { return {arcs_.data(), count_}; }

  bool contains(Angle angle) const;
  bool contains(Arc arc) const;
  std::uint64_t units() const;   // how many angles
  std::uint32_t widest() const;  // the width of the widest arc; 0 of the empty set
  // How far it is from the angle to the nearest end of its arc, in units; 0 outside, kFull in the full
  // circle.
  std::uint32_t margin(Angle angle) const;
  // The angle of the set nearest to this one. Requires that it is not empty.
  Angle nearest(Angle angle) const;

  void add(Arc arc);
  void add(std::span<const Arc> arcs) {
    for (const Arc arc : arcs) add(arc);
  }

  friend bool operator==(const ArcSet& a, const ArcSet& b);

 private:
  void merge_nearest();

  std::array<Arc, kMost + 1> arcs_{};
  std::size_t count_ = 0;
};

ArcSet intersection_of(std::span<const Arc> a, std::span<const Arc> b);
// All sums of an angle of a and one of b; all a - b.
ArcSet sum_of(std::span<const Arc> a, std::span<const Arc> b);
ArcSet difference_of(std::span<const Arc> a, std::span<const Arc> b);
bool meet(std::span<const Arc> a, std::span<const Arc> b);
// The least set of arcs whose ends are whole multiples of a turn by `steps`, away from `zero`, that holds all
// such angles of the set. Requires a power of two.
ArcSet at_steps(const ArcSet& set, std::uint32_t steps, Angle zero);

}  // namespace stepwright::tamp

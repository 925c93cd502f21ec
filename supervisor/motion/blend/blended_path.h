#pragma once

// A path of an arm without corners: straight parts of a polyline, and blends around its way-points. Joints as
// functions of s, which counts along the polyline (doc: supervisor/doc/motion_timing.md).
//
//   const BlendedPath path = *blend(way_points, {.tolerance = 0.05});
//   path.at(0.5 * path.length(), q);              // joints
//   path.at(0.5 * path.length(), slope, 1);       // their derivatives by s
//
// Immutable; any thread. Twice continuously differentiable between way-points where it stops; the third
// derivative is bounded and jumps at the ends of blends.

#include <cstddef>
#include <span>
#include <vector>

#include "supervisor/motion/path/path.h"

namespace stepwright::motion {

// A part of the path with one polynomial. Its joints are
//   q_j(s) = origin_j + before_j * (s - place) [+ turn_j * rounding(s - place, half_width).value]
struct PathPiece {
  std::size_t point = 0;  // the way-point that it goes round, or that a straight part begins at
  bool is_blend = false;
  double begin = 0.0, end = 0.0;  // of s
  double place = 0.0;             // of the way-point
  double half_width = 0.0;        // blends only
  double length() const { return end - begin; }
};

class BlendedPath {
 public:
  // `half_widths`: one for each way-point, 0 at the ends and where the arm stops. Requires way-points that
  // differ, with as many joints each, and blends that do not overlap (blend() sees to that).
  BlendedPath(JointPath points, std::vector<double> half_widths);

  std::size_t joints() const { return points_.front().size(); }
  double length() const { return places_.back(); }
  const JointPath& points() const { return points_; }
  // Of length 1, from each way-point to the next; one less than way-points.
  const std::vector<Configuration>& directions() const { return directions_; }
  const std::vector<double>& places() const { return places_; }
  const std::vector<double>& half_widths() const { return half_widths_; }
  // One after the other, without gaps, from 0 to length().
  const std::vector<PathPiece>& pieces() const { return pieces_; }

  // Joints at s, or their derivative of an order of 1 to 3; s is brought into [0, length()] first. Where the
  // third derivative jumps, that of the piece that begins there. Requires out.size() == joints().
  void at(double s, std::span<double> out, int derivative = 0) const;
  void at(const PathPiece& piece, double s, std::span<double> out, int derivative = 0) const;

  // What a joint of a piece is made of: slope at its begin, and how much it turns (0 for straight parts).
  double before(const PathPiece& piece, std::size_t joint) const {
    return directions_[piece.is_blend ? piece.point - 1 : piece.point][joint];
  }
  double turn(const PathPiece& piece, std::size_t joint) const {
    return piece.is_blend ? directions_[piece.point][joint] - directions_[piece.point - 1][joint] : 0.0;
  }

 private:
  JointPath points_;
  std::vector<Configuration> directions_;
  std::vector<double> places_, half_widths_;
  std::vector<PathPiece> pieces_;
};

}  // namespace stepwright::motion

#pragma once

// Inverse kinematics in closed form of arms with seven joints: a spherical shoulder, a revolute elbow, a
// spherical wrist (S-R-S). The elbow may stand aside of the shoulder's axis (Barrett WAM) or on it (KUKA
// LBR).
//
//   const auto arm = SrsArm::recognise(*chain);                   // nothing: another kind of arm
//   for (const SrsSolution& each : arm->solve(tip, swivel_rad))   // up to 8, all within the limits
//   for (const SwivelArc& arc : arm->arcs(tip))                   // for which swivels there is one at all
//
// Does not change after it was made; any thread; no heap in solve().
//
// A pose of the tip fixes the places of shoulder and wrist, and so the elbow's bend up to its sign. What is
// left is the swivel: the angle of the elbow about the line from shoulder to wrist, 0 where it lies in the
// plane of that line and the first axis, on the side to which the first axis points. Shoulder and wrist then
// have two triples of values each. Sources: Shimizu, Kakuya, Yoon, Kitagaki, Kosuge 2008, Analytical inverse
// kinematic computation for 7-DOF redundant manipulators with joint limits; here by products of exponentials,
// which need no convention of frames.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/motion/kinematics/chain.h"
#include "supervisor/motion/kinematics/orthogonal_axes.h"

namespace stepwright::motion {

// Which of the solutions: bits for the elbow (1: the lesser of the two bends), shoulder and wrist (1:
// flipped).
struct SrsBranch {
  bool elbow = false, shoulder = false, wrist = false;

  static constexpr std::size_t kCount = 8;
  static constexpr SrsBranch number(std::size_t k) { return {(k & 1U) != 0, (k & 2U) != 0, (k & 4U) != 0}; }
  friend bool operator==(const SrsBranch&, const SrsBranch&) = default;
};

struct SrsSolution {
  std::array<double, 7> q{};
  SrsBranch branch;
};

struct SrsSolutions {
  std::array<SrsSolution, SrsBranch::kCount> all;
  std::size_t count = 0;

  const SrsSolution* begin() const { return all.data(); }
  const SrsSolution* end() const { return all.data() + count; }
};

// Swivels for which a branch keeps all limits: from `from_rad` in [-pi, pi) on to `to_rad`, not beyond a
// whole turn.
struct SwivelArc {
  SrsBranch branch;
  double from_rad = 0.0, to_rad = 0.0;
};

class SrsArm {
 public:
  // Nothing for arms that are not of this kind; axes that miss each other by up to 1e-7 m count as meeting.
  static std::optional<SrsArm> recognise(const Chain& chain);

  // All solutions within the limits. Of values that lie a turn apart, the one nearest to the middle of the
  // limits.
  SrsSolutions solve(const Transform& tip, double swivel_rad) const;
  // One of them; nothing where the pose is out of reach or, unless `limits` is false, the limits are not
  // kept.
  std::optional<SrsSolution> solve(const Transform& tip, double swivel_rad, SrsBranch branch,
                                   bool limits = true) const;
  // Exact: their ends are zeros of sinusoids. In the order of the branches, then of `from_rad`; arcs of a
  // branch that meet are one. Narrower ones than 1e-9 rad may be missing.
  std::vector<SwivelArc> arcs(const Transform& tip) const;

  // Of values of the joints: the swivel and branch with which solve() gives them again.
  double swivel(const std::array<double, 7>& q) const;
  SrsBranch branch(const std::array<double, 7>& q) const;

  Transform forward(const std::array<double, 7>& q) const;
  Vector3 shoulder_m() const { return shoulder_m_; }
  Vector3 wrist_m(const Transform& tip) const;
  // The least and the greatest distance of the wrist from the shoulder within the elbow's limits.
  std::array<double, 2> wrist_distance_m() const { return wrist_distance_m_; }

 private:
  // A pose and a bend of the elbow: all but the swivel.
  struct Posture {
    double elbow = 0.0;
    Vector3 line;      // from shoulder to wrist, of length 1
    Rotation at_zero;  // of the upper arm at swivel 0
    Rotation carried;  // what the pose does to the arm as it stands at zero
    Rotation elbow_back;
  };
  std::optional<double> elbow(double distance_m, bool lesser) const;
  std::optional<Posture> posture(const Transform& tip, bool lesser_bend) const;
  Rotation upper_arm(double elbow, Vector3 line) const;
  std::optional<double> within(std::size_t joint, double value) const;
  void add_borders(const OrthogonalAxes& axes, const OrthogonalAxes::Course& course, std::size_t first,
                   std::vector<double>& borders) const;
  bool holds(const OrthogonalAxes& axes, const OrthogonalAxes::Course& course, bool flipped,
             std::size_t first, double swivel_rad) const;

  OrthogonalAxes shoulder_, wrist_;
  Vector3 shoulder_m_, wrist_at_zero_m_;
  Vector3 elbow_axis_, elbow_m_;
  // Squared distance of shoulder and wrist: distance_.at(cos q4, sin q4).
  Sinusoid distance_;
  Transform zero_, zero_back_;  // the tip at 0, and its inverse
  std::array<double, 7> lower_{}, upper_{};
  std::array<double, 2> wrist_distance_m_{};
};

}  // namespace stepwright::motion

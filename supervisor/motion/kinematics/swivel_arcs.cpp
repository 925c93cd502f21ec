#include <algorithm>
#include <cmath>
#include <numbers>

#include "supervisor/motion/kinematics/srs_arm.h"

namespace stepwright::motion {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNarrow_rad = 1e-9;

void add_roots(const Sinusoid& of, std::vector<double>& borders) {
  const Roots found = roots(of);
  borders.insert(borders.end(), found.angles.begin(),
                 found.angles.begin() + static_cast<std::ptrdiff_t>(found.count));
}

// Of sums whose quotient is the tangent of an angle: where the angle is `limit`, or half a turn away from it.
Sinusoid meets(const Sinusoid& sine, const Sinusoid& cosine, double limit) {
  return std::cos(limit) * sine + -std::sin(limit) * cosine;
}

}  // namespace

// All swivels at which one of three values can come to a limit, on either side, and where the first and third
// jump.
void SrsArm::add_borders(const OrthogonalAxes& axes, const OrthogonalAxes::Course& course, std::size_t first,
                         std::vector<double>& borders) const {
  const auto for_limits = [&](std::size_t joint, const auto& add) {
    if (std::isfinite(lower_[joint]) && std::isfinite(upper_[joint]) &&
        upper_[joint] - lower_[joint] < 2.0 * kPi)
      for (const double limit : {lower_[joint], upper_[joint]}) add(limit);
  };
  for_limits(first,
             [&](double limit) { add_roots(meets(course.first_sine, course.first_cosine, limit), borders); });
  for_limits(first + 1, [&](double limit) {
    Sinusoid inner = course.inner;
    inner.constant -= std::cos(limit + axes.skew());
    add_roots(inner, borders);
  });
  for_limits(first + 2,
             [&](double limit) { add_roots(meets(course.third_sine, course.third_cosine, limit), borders); });
  for (const double together : {-1.0, 1.0}) {
    Sinusoid inner = course.inner;
    inner.constant -= together;
    add_roots(inner, borders);
  }
}

bool SrsArm::holds(const OrthogonalAxes& axes, const OrthogonalAxes::Course& course, bool flipped,
                   std::size_t first, double swivel_rad) const {
  const double side = flipped ? -1.0 : 1.0, c = std::cos(swivel_rad), s = std::sin(swivel_rad);
  const double y = course.first_sine.at(c, s), x = course.first_cosine.at(c, s);
  const double inner = side * std::atan2(std::hypot(x, y), course.inner.at(c, s));
  return within(first + 1, inner - axes.skew()) && within(first, std::atan2(side * y, side * x)) &&
         within(first + 2,
                std::atan2(side * course.third_sine.at(c, s), side * course.third_cosine.at(c, s)));
}

std::vector<SwivelArc> SrsArm::arcs(const Transform& tip) const {
  // Of a bend of the elbow: where a limit can be met, and which flips of shoulder and wrist hold from there
  // on. The four branches of a bend have the same borders, so that they are looked for once.
  struct Part {
    double from_rad = 0.0, to_rad = 0.0;
    bool shoulder[2] = {}, wrist[2] = {};
  };
  std::vector<Part> parts[2];
  std::vector<double> borders;
  for (const bool lesser : {false, true}) {
    const auto posture = this->posture(tip, lesser);
    if (!posture || !within(3, posture->elbow)) continue;
    // The upper arm is about(line, t) at_zero; the hand elbow_back at_zero^T about(line, -t) carried.
    const Rotation back = transposed(posture->at_zero);
    const auto shoulder = shoulder_.course(GoingRound(posture->line, posture->at_zero * shoulder_.third()),
                                           GoingRound(-(back * posture->line), back * shoulder_.first()));
    const Rotation fore = posture->elbow_back * back;
    const Rotation carried_back = transposed(posture->carried);
    const auto wrist = wrist_.course(
        GoingRound(-(fore * posture->line), fore * (posture->carried * wrist_.third())),
        GoingRound(carried_back * posture->line, carried_back * (transposed(fore) * wrist_.first())));
    borders.assign({-kPi});
    add_borders(shoulder_, shoulder, 0, borders);
    add_borders(wrist_, wrist, 4, borders);
    std::sort(borders.begin(), borders.end());
    for (std::size_t b = 0; b < borders.size(); ++b) {
      Part part;
      part.from_rad = borders[b];
      part.to_rad = b + 1 < borders.size() ? borders[b + 1] : kPi;
      if (part.to_rad - part.from_rad < kNarrow_rad) continue;
      const double middle = 0.5 * (part.from_rad + part.to_rad);
      for (const bool flipped : {false, true})
        part.shoulder[flipped] = holds(shoulder_, shoulder, flipped, 0, middle);
      if (part.shoulder[0] || part.shoulder[1])
        for (const bool flipped : {false, true})
          part.wrist[flipped] = holds(wrist_, wrist, flipped, 4, middle);
      parts[lesser].push_back(part);
    }
  }
  std::vector<SwivelArc> found;
  for (std::size_t k = 0; k < SrsBranch::kCount; ++k) {
    const SrsBranch branch = SrsBranch::number(k);
    const std::size_t first_of_branch = found.size();
    for (const Part& part : parts[branch.elbow]) {
      if (!part.shoulder[branch.shoulder] || !part.wrist[branch.wrist]) continue;
      if (found.size() > first_of_branch && part.from_rad - found.back().to_rad < kNarrow_rad)
        found.back().to_rad = part.to_rad;
      else
        found.push_back({branch, part.from_rad, part.to_rad});
    }
    // Over the seam at pi.
    if (found.size() > first_of_branch + 1 && found[first_of_branch].from_rad + kPi < kNarrow_rad &&
        kPi - found.back().to_rad < kNarrow_rad) {
      found.back().to_rad = found[first_of_branch].to_rad + 2.0 * kPi;
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(first_of_branch));
    }
  }
  return found;
}

}  // namespace stepwright::motion

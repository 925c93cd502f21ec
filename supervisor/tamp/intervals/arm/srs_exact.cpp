#include "supervisor/tamp/intervals/arm/srs_exact.h"

#include <cmath>
#include <utility>

namespace stepwright::tamp {
namespace {

// The elbow has so much room: what is reached with less is not reached by those who round a number.
constexpr double kRoom_rad = 0.1;

motion::Transform hanging(const Point3& at, const Point3& base_nm, Angle angle) {
  const double c = std::cos(radians_of(angle)), s = std::sin(radians_of(angle));
  return {motion::from_columns({c, s, 0.0}, {s, -c, 0.0}, {0.0, 0.0, -1.0}),
          {metres_of(at[0] - base_nm[0]), metres_of(at[1] - base_nm[1]), metres_of(at[2] - base_nm[2])}};
}

}  // namespace

std::optional<SrsExact> SrsExact::make(const motion::Chain& chain, const Point3& base_nm) {
  auto bounds = SrsReach::make(chain);
  const auto arm = motion::SrsArm::recognise(chain);
  if (!bounds || !arm) return std::nullopt;
  return SrsExact(*std::move(bounds), *arm, base_nm);
}

bool SrsExact::reaches(const Point3& at, Angle angle) const {
  const motion::Transform tip = hanging(at, base_nm_, angle);
  for (const motion::SwivelArc& arc : arm_.arcs(tip))
    if (arc.to_rad - arc.from_rad >= kRoom_rad &&
        arm_.solve(tip, 0.5 * (arc.from_rad + arc.to_rad), arc.branch))
      return true;
  return false;
}

ArcSet SrsExact::near(const Point3& at) const {
  Box point;
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = {at[axis] - base_nm_[axis], at[axis] - base_nm_[axis]};
  return bounds_.arcs_over(point);
}

}  // namespace stepwright::tamp

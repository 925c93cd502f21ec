#include "supervisor/motion/timing/internal/greatest_share.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "supervisor/motion/timing/internal/bernstein.h"
#include "supervisor/motion/timing/internal/roots.h"

namespace stepwright::motion::internal {

namespace {

using Coefficients = std::array<double, kMostDegree + 1>;

// First to third derivatives by time, in Bernstein's basis of one degree each.
struct InTime {
  std::array<Coefficients, 3> of{};
  std::array<std::size_t, 3> degree{};
};

InTime in_time(Polynomial of, std::size_t degree, double duration) {
  InTime made;
  double rate = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    of = derivative(of);
    rate /= duration;
    made.degree[k] = degree - k - 1;
    made.of[k] = bernstein(of, made.degree[k]);
    for (double& each : made.of[k]) each *= rate;
  }
  return made;
}

double largest(const InTime& place, const InTime& round, std::size_t order, double before, double turn) {
  double most = 0.0;
  for (std::size_t k = 0; k <= place.degree[order]; ++k)
    most = std::max(most, std::abs(before * place.of[order][k] + turn * round.of[order][k]));
  return most;
}

}  // namespace

void Share::raise(const Share& other) {
  velocity = std::max(velocity, other.velocity);
  acceleration = std::max(acceleration, other.acceleration);
  jerk = std::max(jerk, other.jerk);
}

double Share::stretch() const {
  return std::max({velocity, std::sqrt(acceleration), cube_root(jerk)});
}

Share greatest_share(const BlendedPath& path, const PathPiece& piece, const TimeRow& row,
                     const JointLimits& limits) {
  Polynomial place;
  place.degree = 5;
  std::copy(row.c.begin(), row.c.end(), place.c.begin());
  place.c[0] -= piece.place;
  const std::size_t degree = piece.is_blend ? kMostDegree : 5;
  InTime round;
  if (piece.is_blend) {
    Polynomial x = place;
    for (double& each : x.c) each /= piece.half_width;
    const Polynomial square = product(x, x), fourth = product(square, square);
    Polynomial ramp;  // rounding() without its constant
    ramp.degree = kMostDegree;
    for (std::size_t k = 0; k <= kMostDegree; ++k)
      ramp.c[k] = piece.half_width * (8.0 * x.c[k] + 6.0 * square.c[k] - fourth.c[k]) / 16.0;
    round = in_time(ramp, degree, row.duration);
  }
  const InTime straight = in_time(place, degree, row.duration);
  Share share;
  for (std::size_t j = 0; j < path.joints(); ++j) {
    const double before = path.before(piece, j), turn = path.turn(piece, j);
    share.raise({largest(straight, round, 0, before, turn) / limits.velocity[j],
                 largest(straight, round, 1, before, turn) / limits.acceleration[j],
                 largest(straight, round, 2, before, turn) / limits.jerk[j]});
  }
  return share;
}

}  // namespace stepwright::motion::internal

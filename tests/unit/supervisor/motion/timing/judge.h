#pragma once

// A judge of motions that shares nothing with the planner: samples of joints' derivatives by the chain rule.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>

#include "supervisor/motion/blend/blend.h"
#include "supervisor/motion/spatial/random.h"
#include "supervisor/motion/timing/plan_timing.h"

namespace stepwright::motion::tests {

struct Verdict {
  double worst = 0.0;   // greatest use of a limit, 1 = met
  double broken = 0.0;  // greatest jump of place, speed or acceleration between rows, over their size
  bool forward = true;  // the place never goes back
};

inline Verdict judge(const BlendedPath& path, const TimeLaw& law, const JointLimits& limits,
                     int samples = 12) {
  Verdict verdict;
  Configuration first(path.joints()), second(path.joints()), third(path.joints());
  double most_speed = 1e-9, most_acceleration = 1e-9;
  for (const TimeRow& row : law.rows) {
    // A row lies within a piece; at its ends the third derivative jumps.
    const double middle = along(row, 0.5).place;
    std::size_t at = 0;
    while (at + 1 < path.pieces().size() && path.pieces()[at].end < middle) ++at;
    const PathPiece& piece = path.pieces()[at];
    for (int k = 0; k <= samples; ++k) {
      const Along now = along(row, static_cast<double>(k) / samples);
      verdict.forward = verdict.forward && now.speed >= -1e-9;
      path.at(piece, now.place, first, 1);
      path.at(piece, now.place, second, 2);
      path.at(piece, now.place, third, 3);
      const double v = now.speed, a = now.acceleration;
      most_speed = std::max(most_speed, v);
      most_acceleration = std::max(most_acceleration, std::abs(a));
      for (std::size_t j = 0; j < path.joints(); ++j)
        verdict.worst =
            std::max({verdict.worst, std::abs(first[j] * v) / limits.velocity[j],
                      std::abs(second[j] * v * v + first[j] * a) / limits.acceleration[j],
                      std::abs(third[j] * v * v * v + 3.0 * second[j] * v * a + first[j] * now.jerk) /
                          limits.jerk[j]});
    }
  }
  Along before{0.0, along(law.rows.front(), 0.0).speed, 0.0, 0.0};
  const auto compare = [&](const Along& a, const Along& b) {
    verdict.broken = std::max({verdict.broken, std::abs(a.place - b.place) / path.length(),
                               std::abs(a.speed - b.speed) / most_speed,
                               std::abs(a.acceleration - b.acceleration) / most_acceleration});
  };
  for (const TimeRow& row : law.rows) {
    compare(before, along(row, 0.0));
    before = along(row, 1.0);
  }
  compare(before, {path.length(), 0.0, 0.0, 0.0});
  return verdict;
}

struct TimingCase {
  JointPath points;
  JointLimits limits;
  double tolerance = 0.0;
};

// Way-points of an arm, and limits as drives have them.
inline TimingCase random_case(Random& random, std::size_t points, std::size_t joints) {
  TimingCase made;
  for (std::size_t k = 0; k < points; ++k) {
    made.points.emplace_back();
    for (std::size_t j = 0; j < joints; ++j)
      made.points.back().push_back(k == 0 ? random.between(-2.0, 2.0)
                                          : made.points[k - 1][j] + random.between(-0.8, 0.8));
  }
  for (std::size_t j = 0; j < joints; ++j) {
    made.limits.velocity.push_back(random.between(1.0, 3.0));
    made.limits.acceleration.push_back(random.between(3.0, 15.0));
    made.limits.jerk.push_back(random.between(20.0, 200.0));
  }
  made.tolerance = random.between(0.01, 0.1);
  return made;
}

// FNV-1a of the bits.
inline std::uint64_t hash_of(std::span<const double> values, std::uint64_t hash = 0xCBF29CE484222325U) {
  for (const double value : values) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    for (int k = 0; k < 8; ++k) hash = (hash ^ ((bits >> (8 * k)) & 0xFFU)) * 0x100000001B3U;
  }
  return hash;
}

inline std::uint64_t hash_of(const TimeLaw& law) {
  std::uint64_t hash = hash_of(std::span<const double>{});
  for (const TimeRow& row : law.rows) hash = hash_of(row.c, hash_of({&row.duration, 1}, hash));
  return hash;
}

}  // namespace stepwright::motion::tests

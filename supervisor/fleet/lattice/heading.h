#pragma once

// The sixteen headings of the lattice, and vectors of whole numbers between its vertices. Pure functions.
//
// Each heading is the direction of a short vector of the grid, (1,0), (2,1), (1,1), (1,2) and these turned by
// right angles: 0, 26.57, 45, 63.43 degrees ... (Pivtoraiko, Knepper, Kelly 2009, section 4.2). Straight
// motion along it ends exactly on a vertex, which no multiple of 22.5 degrees but those of 45 would allow.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace stepwright::fleet {

struct GridVector {
  std::int32_t x = 0;
  std::int32_t y = 0;

  friend bool operator==(const GridVector&, const GridVector&) = default;
  friend GridVector operator+(GridVector a, GridVector b) { return {a.x + b.x, a.y + b.y}; }
  friend GridVector operator-(GridVector a, GridVector b) { return {a.x - b.x, a.y - b.y}; }
  friend GridVector operator*(std::int32_t factor, GridVector a) { return {factor * a.x, factor * a.y}; }
};

inline constexpr int kHeadings = 16;
inline constexpr int kQuarter = kHeadings / 4;  // headings in a right angle

// A heading counts anticlockwise from the x axis; any whole number names one.
constexpr int wrap_heading(int heading) {
  return (heading % kHeadings + kHeadings) % kHeadings;
}

// By `quarters` right angles anticlockwise, 0 to 3.
constexpr GridVector turned(GridVector v, int quarters) {
  for (; quarters > 0; --quarters) v = {-v.y, v.x};
  return v;
}

// The shortest vector of the grid in this direction.
constexpr GridVector heading_vector(int heading) {
  constexpr std::array<GridVector, kQuarter> kFirst = {GridVector{1, 0}, {2, 1}, {1, 1}, {1, 2}};
  const int wrapped = wrap_heading(heading);
  return turned(kFirst[static_cast<std::size_t>(wrapped % kQuarter)], wrapped / kQuarter);
}

// In (-pi, pi].
inline double heading_rad(int heading) {
  const GridVector v = heading_vector(heading);
  return std::atan2(v.y, v.x);
}

inline int nearest_heading(double angle_rad) {
  int best = 0;
  double best_cosine = -2.0;
  for (int heading = 0; heading < kHeadings; ++heading) {
    const double cosine = std::cos(angle_rad - heading_rad(heading));
    if (cosine > best_cosine) {
      best_cosine = cosine;
      best = heading;
    }
  }
  return best;
}

}  // namespace stepwright::fleet

#include "supervisor/fleet/lattice/primitive_set.h"

#include <sodium/crypto_hash_sha256.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "supervisor/fleet/lattice/internal/curve_solver.h"

namespace stepwright::fleet {

namespace {

using internal::CurveLimits;
constexpr std::size_t kForward = PrimitiveSet::kPerHeading / 2;
using Forward = std::array<MotionPrimitive, kForward>;

MotionPrimitive turned_by(MotionPrimitive primitive, int quarters) {
  primitive.start_heading = wrap_heading(primitive.start_heading + quarters * kQuarter);
  primitive.end_heading = wrap_heading(primitive.end_heading + quarters * kQuarter);
  primitive.end = turned(primitive.end, quarters);
  return primitive;
}

// In the mirror along the diagonal x = y, or along the x axis.
MotionPrimitive mirrored(MotionPrimitive primitive, bool diagonal) {
  const int sum = diagonal ? kQuarter : 0;
  primitive.start_heading = wrap_heading(sum - primitive.start_heading);
  primitive.end_heading = wrap_heading(sum - primitive.end_heading);
  primitive.end =
      diagonal ? GridVector{primitive.end.y, primitive.end.x} : GridVector{primitive.end.x, -primitive.end.y};
  for (Segment& segment : primitive.segments) segment.curvature_1pm = -segment.curvature_1pm;
  return primitive;
}

// Left before right in each pair: a mirror swaps the two of a pair.
Forward solve_all(int heading, int long_steps, const CurveLimits& limits) {
  return {internal::straight_line(heading, 1, limits),  internal::straight_line(heading, long_steps, limits),
          internal::solve_turn(heading, 1, limits),     internal::solve_turn(heading, -1, limits),
          internal::solve_turn(heading, 2, limits),     internal::solve_turn(heading, -2, limits),
          internal::solve_shift(heading, true, limits), internal::solve_shift(heading, false, limits)};
}

Forward in_mirror(const Forward& set, bool diagonal) {
  return {mirrored(set[0], diagonal), mirrored(set[1], diagonal), mirrored(set[3], diagonal),
          mirrored(set[2], diagonal), mirrored(set[5], diagonal), mirrored(set[4], diagonal),
          mirrored(set[7], diagonal), mirrored(set[6], diagonal)};
}

// The headings 0 and 2 are their own mirror images: what turns right is the image of what turns left.
Forward made_symmetric(Forward set, bool diagonal) {
  for (const std::size_t right : {3u, 5u, 7u}) set[right] = mirrored(set[right - 1], diagonal);
  return set;
}

// From the end back to the start: the same track, which seen from its other end turns to the other side.
MotionPrimitive backwards(const MotionPrimitive& forward) {
  MotionPrimitive primitive = forward;
  std::swap(primitive.start_heading, primitive.end_heading);
  primitive.end = GridVector{} - forward.end;
  primitive.travel = geometry::Travel::Reverse;
  std::ranges::reverse(primitive.segments);
  for (Segment& segment : primitive.segments) segment.curvature_1pm = -segment.curvature_1pm;
  return primitive;
}

std::uint32_t cost_of(const MotionPrimitive& primitive, const LatticeOptions& options) {
  const double factor = (primitive.straight() ? 1.0 : options.turn_factor) *
                        (primitive.travel == geometry::Travel::Reverse ? options.reverse_factor : 1.0);
  // Whole lengths shall not gain a millimetre by rounding in floating point.
  return static_cast<std::uint32_t>(std::ceil(1000.0 * primitive.length_m * factor - 1e-6));
}

void put(std::vector<std::uint8_t>& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

}  // namespace

PrimitiveSet::PrimitiveSet(const VehicleModel& vehicle, const LatticeOptions& options) : options_(options) {
  assert(check(vehicle, {}, "").empty());
  assert(options.resolution_m > 0.0 && options.reverse_factor >= 1.0 && options.turn_factor >= 1.0);
  const CurveLimits limits{options.resolution_m, vehicle.min_turning_radius_m};
  const auto long_steps = [&](int heading) {
    const GridVector v = heading_vector(heading);
    const double step_m = options.resolution_m * std::hypot(v.x, v.y);
    return std::max(2, static_cast<int>(std::lround(options.long_straight_m / step_m)));
  };
  const Forward slanted = solve_all(1, long_steps(1), limits);
  const std::array<Forward, kQuarter> first = {
      made_symmetric(solve_all(0, long_steps(0), limits), false), slanted,
      made_symmetric(solve_all(2, long_steps(2), limits), true), in_mirror(slanted, true)};
  primitives_.resize(std::size_t{kHeadings} * kPerHeading);
  for (int heading = 0; heading < kHeadings; ++heading) {
    for (std::size_t k = 0; k < kForward; ++k) {
      const auto at = [&](int start, std::size_t index) -> MotionPrimitive& {
        return primitives_[static_cast<std::size_t>(start) * kPerHeading + index];
      };
      const MotionPrimitive forward =
          turned_by(first[static_cast<std::size_t>(heading % kQuarter)][k], heading / kQuarter);
      at(heading, k) = forward;
      at(forward.end_heading, kForward + k) = backwards(forward);
    }
  }
  for (MotionPrimitive& primitive : primitives_) primitive.cost_mm = cost_of(primitive, options);
}

Digest PrimitiveSet::digest() const {
  std::vector<std::uint8_t> bytes;
  put(bytes, std::bit_cast<std::uint64_t>(options_.resolution_m));
  for (const MotionPrimitive& primitive : primitives_) {
    put(bytes, static_cast<std::uint64_t>(primitive.start_heading * kHeadings + primitive.end_heading));
    put(bytes, static_cast<std::uint64_t>(static_cast<std::int64_t>(primitive.end.x)));
    put(bytes, static_cast<std::uint64_t>(static_cast<std::int64_t>(primitive.end.y)));
    put(bytes, primitive.cost_mm);
  }
  Digest digest{};
  crypto_hash_sha256(digest.data(), bytes.data(), bytes.size());
  return digest;
}

}  // namespace stepwright::fleet

#include "supervisor/tamp/intervals/reach/arc_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::tamp {
namespace {

constexpr double kUnitsOfTurn = 4294967296.0;
constexpr double kUnitsOfRad = kUnitsOfTurn / (2.0 * std::numbers::pi);
// More than what the conversion of an angle of a few turns can be off, in units.
constexpr double kOff = 1e-3;

Angle wrapped(double units) {
  const double turns = std::floor(units / kUnitsOfTurn);
  return static_cast<Angle>(static_cast<std::int64_t>(units - turns * kUnitsOfTurn));
}

// With no angle between them that is in neither.
bool touch(Arc a, Arc b) {
  return static_cast<std::uint64_t>(b.low - a.low) <= std::uint64_t{a.width} + 1 ||
         static_cast<std::uint64_t>(a.low - b.low) <= std::uint64_t{b.width} + 1;
}

Arc joined_from(Arc first, Arc second) {
  const std::uint64_t width =
      std::max<std::uint64_t>(first.width, static_cast<std::uint64_t>(second.low - first.low) + second.width);
  if (width >= Arc::kFull) return {0, Arc::kFull};
  return {first.low, static_cast<std::uint32_t>(width)};
}

// Requires that they touch.
Arc joined(Arc a, Arc b) {
  const bool b_follows = static_cast<std::uint64_t>(b.low - a.low) <= std::uint64_t{a.width} + 1;
  return b_follows ? joined_from(a, b) : joined_from(b, a);
}

std::uint32_t added(std::uint32_t a, std::uint32_t b) {
  const std::uint64_t width = std::uint64_t{a} + b;
  return width >= Arc::kFull ? Arc::kFull : static_cast<std::uint32_t>(width);
}

Arc normal(Angle low, std::uint32_t width) {
  return width == Arc::kFull ? Arc{0, Arc::kFull} : Arc{low, width};
}

}  // namespace

Angle angle_of(double rad) {
  return wrapped(std::nearbyint(rad * kUnitsOfRad));
}

double radians_of(Angle angle) {
  return static_cast<double>(static_cast<std::int32_t>(angle)) / kUnitsOfRad;
}

double turn_rad(Angle from, Angle to) {
  return radians_of(to - from);
}

Arc arc_outward(double low_rad, double high_rad) {
  const double low = std::floor(low_rad * kUnitsOfRad - kOff),
               high = std::ceil(high_rad * kUnitsOfRad + kOff);
  const double width = high - low;
  if (!(width < static_cast<double>(Arc::kFull))) return {0, Arc::kFull};
  return {wrapped(low), static_cast<std::uint32_t>(width)};
}

bool ArcSet::contains(Angle angle) const {
  for (std::size_t k = 0; k < count_; ++k)
    if (arcs_[k].contains(angle)) return true;
  return false;
}

bool ArcSet::contains(Arc arc) const {
  for (std::size_t k = 0; k < count_; ++k)
    if (arcs_[k].width == Arc::kFull || arcs_[k].contains(arc)) return true;
  return false;
}

std::uint64_t ArcSet::units() const {
  std::uint64_t sum = 0;
  for (std::size_t k = 0; k < count_; ++k) sum += std::uint64_t{arcs_[k].width} + 1;
  return sum;
}

std::uint32_t ArcSet::widest() const {
  std::uint32_t most = 0;
  for (std::size_t k = 0; k < count_; ++k) most = std::max(most, arcs_[k].width);
  return most;
}

std::uint32_t ArcSet::margin(Angle angle) const {
  for (std::size_t k = 0; k < count_; ++k) {
    if (arcs_[k].width == Arc::kFull) return Arc::kFull;
    if (arcs_[k].contains(angle)) return std::min(angle - arcs_[k].low, arcs_[k].high() - angle);
  }
  return 0;
}

Angle ArcSet::nearest(Angle angle) const {
  Angle best = arcs_[0].low;
  std::uint32_t best_off = Arc::kFull;
  const auto offer = [&](Angle at) {
    const std::uint32_t off = std::min(at - angle, angle - at);
    if (off >= best_off) return;
    best_off = off;
    best = at;
  };
  for (std::size_t k = 0; k < count_; ++k) {
    if (arcs_[k].contains(angle)) return angle;
    offer(arcs_[k].low);
    offer(arcs_[k].high());
  }
  return best;
}

void ArcSet::add(Arc arc) {
  if (arc.width == Arc::kFull) {
    *this = full();
    return;
  }
  if (contains(arc)) return;
  for (std::size_t k = 0; k < count_;) {
    if (!touch(arcs_[k], arc)) {
      ++k;
      continue;
    }
    arc = joined(arcs_[k], arc);
    std::copy(arcs_.begin() + static_cast<std::ptrdiff_t>(k) + 1,
              arcs_.begin() + static_cast<std::ptrdiff_t>(count_),
              arcs_.begin() + static_cast<std::ptrdiff_t>(k));
    --count_;
    k = 0;
  }
  std::size_t at = count_++;
  for (; at > 0 && arcs_[at - 1].low > arc.low; --at) arcs_[at] = arcs_[at - 1];
  arcs_[at] = arc;
  if (count_ > kMost) merge_nearest();
}

void ArcSet::merge_nearest() {
  std::size_t best = 0;
  std::uint32_t least = Arc::kFull;
  for (std::size_t k = 0; k < count_; ++k) {
    const std::uint32_t gap = arcs_[(k + 1) % count_].low - arcs_[k].high();
    if (gap > least) continue;
    least = gap;
    best = k;
  }
  const std::size_t next = (best + 1) % count_;
  const Arc both = joined_from(arcs_[best], arcs_[next]);
  ArcSet merged;
  for (std::size_t k = 0; k < count_; ++k)
    if (k != best && k != next) merged.add(arcs_[k]);
  merged.add(both);
  *this = merged;
}

bool operator==(const ArcSet& a, const ArcSet& b) {
  return std::ranges::equal(a.arcs(), b.arcs());
}

ArcSet intersection_of(std::span<const Arc> a, std::span<const Arc> b) {
  ArcSet both;
  for (const Arc one : a) {
    for (const Arc other : b) {
      if (one.width == Arc::kFull || other.width == Arc::kFull) {
        both.add(one.width == Arc::kFull ? other : one);
        continue;
      }
      const std::uint32_t after = other.low - one.low, before = one.low - other.low;
      if (after <= one.width) both.add({other.low, std::min(one.width - after, other.width)});
      if (after != 0 && before <= other.width) both.add({one.low, std::min(other.width - before, one.width)});
    }
  }
  return both;
}

ArcSet sum_of(std::span<const Arc> a, std::span<const Arc> b) {
  ArcSet sums;
  for (const Arc one : a)
    for (const Arc other : b) sums.add(normal(one.low + other.low, added(one.width, other.width)));
  return sums;
}

ArcSet difference_of(std::span<const Arc> a, std::span<const Arc> b) {
  ArcSet differences;
  for (const Arc one : a)
    for (const Arc other : b) differences.add(normal(one.low - other.high(), added(one.width, other.width)));
  return differences;
}

bool meet(std::span<const Arc> a, std::span<const Arc> b) {
  for (const Arc one : a)
    for (const Arc other : b)
      if (other.low - one.low <= one.width || one.low - other.low <= other.width) return true;
  return false;
}

ArcSet at_steps(const ArcSet& set, std::uint32_t steps, Angle zero) {
  if (set.is_full() || steps == 0) return set;
  const auto step = static_cast<std::uint32_t>((std::uint64_t{1} << 32) / steps);
  ArcSet snapped;
  for (const Arc arc : set.arcs()) {
    const std::uint32_t past = (arc.low - zero) % step;
    const std::uint32_t up = past == 0 ? 0 : step - past;  // to the first step
    if (up > arc.width) continue;
    snapped.add({arc.low + up, (arc.width - up) / step * step});
  }
  return snapped;
}

}  // namespace stepwright::tamp

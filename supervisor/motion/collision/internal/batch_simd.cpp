// As many configurations together as a vector of the machine has lanes: each lane computes what
// batch_scalar.cpp computes. Compiled once for each instruction set: foreach_target.h includes this file
// again. No product is added without being rounded (no MulAdd), so that all of them agree.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "supervisor/motion/collision/internal/batch_simd.cpp"
#include <hwy/foreach_target.h>  // before highway.h

#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "supervisor/motion/collision/internal/program.h"

HWY_BEFORE_NAMESPACE();
namespace stepwright::motion::internal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<float>;
using V = hn::Vec<Tag>;
using M = hn::Mask<Tag>;
using V3 = std::array<V, 3>;

constexpr std::size_t kPlaceVectors = 12;  // rotation row by row, position

HWY_INLINE V set(float value) {
  return hn::Set(Tag(), value);
}

HWY_INLINE void sine_cosine(V x, V& sine, V& cosine) {
  const V k = hn::Floor(hn::Add(hn::Mul(x, set(kTwoOverPi)), set(0.5F)));
  V r = hn::Sub(x, hn::Mul(k, set(kHalfPi[0])));
  r = hn::Sub(r, hn::Mul(k, set(kHalfPi[1])));
  r = hn::Sub(r, hn::Mul(k, set(kHalfPi[2])));
  const V z = hn::Mul(r, r);
  V s = hn::Add(hn::Mul(set(kSine[3]), z), set(kSine[2]));
  s = hn::Add(hn::Mul(s, z), set(kSine[1]));
  s = hn::Add(hn::Mul(s, z), set(kSine[0]));
  s = hn::Add(r, hn::Mul(hn::Mul(r, z), s));
  V c = hn::Add(hn::Mul(set(kCosine[3]), z), set(kCosine[2]));
  c = hn::Add(hn::Mul(c, z), set(kCosine[1]));
  c = hn::Add(hn::Mul(c, z), set(kCosine[0]));
  c = hn::Add(hn::Mul(c, z), set(1.0F));
  const V quarter = hn::Sub(k, hn::Mul(set(4.0F), hn::Floor(hn::Mul(k, set(0.25F)))));
  const M one = hn::Eq(quarter, set(1.0F)), two = hn::Eq(quarter, set(2.0F)),
          three = hn::Eq(quarter, set(3.0F));
  const M odd = hn::Or(one, three);
  const V to_sine = hn::IfThenElse(odd, c, s), to_cosine = hn::IfThenElse(odd, s, c);
  sine = hn::IfThenElse(hn::Or(two, three), hn::Neg(to_sine), to_sine);
  cosine = hn::IfThenElse(hn::Or(one, two), hn::Neg(to_cosine), to_cosine);
}

// a x + b y + c z with figures that are the same in all lanes.
HWY_INLINE V sum_of(V a, V b, V c, const float* v) {
  return hn::Add(hn::Add(hn::Mul(a, set(v[0])), hn::Mul(b, set(v[1]))), hn::Mul(c, set(v[2])));
}
HWY_INLINE V sum_of(V a, V b, V c, const V3& v) {
  return hn::Add(hn::Add(hn::Mul(a, v[0]), hn::Mul(b, v[1])), hn::Mul(c, v[2]));
}
HWY_INLINE V square(V x, V y, V z) {
  return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

class Batch {
 public:
  // Vectors one after the other: places of bodies, columns of configurations, centres of links, of groups of
  // spheres, of spheres.
  explicit Batch(const Program& program)
      : program_(program),
        lanes_(hn::Lanes(Tag())),
        columns_at_((program.steps.size() + 1) * kPlaceVectors),
        middles_at_(columns_at_ + program.columns),
        groups_at_(middles_at_ + 3 * program.moving_parts),
        centres_at_(groups_at_ + 3 * program.moving_groups),
        vectors_(hwy::AllocateAligned<float>((centres_at_ + 3 * program.moving_balls) * lanes_)),
        has_groups_(program.moving_parts),
        has_centres_(program.moving_groups) {
    const std::array<float, kPlaceVectors> still{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    for (std::size_t k = 0; k < kPlaceVectors; ++k) store(set(still[k]), k);
  }

  std::size_t lanes() const { return lanes_; }

  // `count` rows, at most lanes(). True if one collides; `any`: the others are then not looked at.
  HWY_INLINE bool check(const double* rows, std::size_t count, bool any, std::uint8_t* collides) {
    load(rows, count);
    place();
    std::fill(has_centres_.begin(), has_centres_.end(), std::uint8_t{0});
    for (std::size_t k = 0; k < program_.moving_parts; ++k) {
      has_groups_[k] = 0;
      store(carried(program_.parts[k].body, program_.parts[k].bound.centre), middles_at_ + 3 * k);
    }
    const M unused = hn::Not(hn::FirstN(Tag(), count));
    const M none = hn::FirstN(Tag(), 0);
    M hit = none;
    const auto enough = [&] {
      return any ? !hn::AllFalse(Tag(), hn::AndNot(unused, hit)) : hn::AllTrue(Tag(), hn::Or(hit, unused));
    };
    bool done = false;
    for (std::size_t k = 0; k < program_.moving_parts && !done; ++k) {
      meet_world(k, hit);
      done = enough();
    }
    for (std::size_t k = 0; k < program_.pairs.size() && !done; ++k)
      if (meet(program_.pairs[k].first, program_.pairs[k].second, hit)) done = enough();
    const V flags = hn::IfThenElse(hit, set(1.0F), set(0.0F));
    HWY_ALIGN std::array<float, hn::MaxLanes(Tag())> out;
    hn::Store(flags, Tag(), out.data());
    bool found = false;
    for (std::size_t k = 0; k < count; ++k) {
      collides[k] = out[k] != 0.0F;
      found = found || collides[k] != 0;
    }
    return found;
  }

 private:
  HWY_INLINE V vector(std::size_t which) const { return hn::Load(Tag(), &vectors_[which * lanes_]); }
  HWY_INLINE V3 three(std::size_t first) const {
    return {vector(first), vector(first + 1), vector(first + 2)};
  }
  HWY_INLINE void store(V value, std::size_t which) { hn::Store(value, Tag(), &vectors_[which * lanes_]); }
  HWY_INLINE void store(const V3& values, std::size_t first) {
    for (std::size_t i = 0; i < 3; ++i) store(values[i], first + i);
  }

  HWY_INLINE void load(const double* rows, std::size_t count) {
    for (std::size_t column = 0; column < program_.columns; ++column)
      for (std::size_t lane = 0; lane < lanes_; ++lane)
        vectors_[(columns_at_ + column) * lanes_ + lane] =
            static_cast<float>(rows[(lane < count ? lane : count - 1) * program_.columns + column]);
  }

  HWY_INLINE V of_place(std::size_t body, std::size_t which) const {
    return vector(body * kPlaceVectors + which);
  }

  HWY_INLINE void place() {
    for (std::size_t k = 0; k < program_.steps.size(); ++k) {
      const BodyStep& step = program_.steps[k];
      const std::size_t at = (k + 1) * kPlaceVectors;
      const V value =
          hn::Add(hn::Mul(vector(columns_at_ + step.column), set(step.multiplier)), set(step.offset));
      std::array<V, 9> turned;
      V3 origin{set(step.origin[0]), set(step.origin[1]), set(step.origin[2])};
      if (step.slides) {
        for (std::size_t i = 0; i < 9; ++i) turned[i] = set(step.still[i]);
        for (std::size_t i = 0; i < 3; ++i)
          origin[i] = hn::Add(origin[i], hn::Mul(value, set(step.along[i])));
      } else {
        V s, c;
        sine_cosine(value, s, c);
        for (std::size_t i = 0; i < 9; ++i)
          turned[i] = hn::Add(hn::Add(set(step.still[i]), hn::Mul(c, set(step.with_cosine[i]))),
                              hn::Mul(s, set(step.with_sine[i])));
      }
      for (std::size_t row = 0; row < 3; ++row) {
        const V a = of_place(step.parent, 3 * row), b = of_place(step.parent, 3 * row + 1),
                c = of_place(step.parent, 3 * row + 2);
        for (std::size_t i = 0; i < 3; ++i)
          store(sum_of(a, b, c, V3{turned[i], turned[3 + i], turned[6 + i]}), at + 3 * row + i);
        store(hn::Add(sum_of(a, b, c, origin), of_place(step.parent, 9 + row)), at + 9 + row);
      }
    }
  }

  HWY_INLINE V3 carried(std::size_t body, const std::array<float, 3>& point) const {
    V3 out;
    for (std::size_t row = 0; row < 3; ++row)
      out[row] = hn::Add(sum_of(of_place(body, 3 * row), of_place(body, 3 * row + 1),
                                of_place(body, 3 * row + 2), point.data()),
                         of_place(body, 9 + row));
    return out;
  }

  HWY_INLINE void groups_of(std::size_t part) {
    if (part >= program_.moving_parts || has_groups_[part] != 0) return;
    has_groups_[part] = 1;
    const Part& of = program_.parts[part];
    for (std::size_t k = of.first_group; k < of.end_group; ++k)
      store(carried(of.body, program_.groups[k].bound.centre), groups_at_ + 3 * k);
  }

  HWY_INLINE void centres_of(std::size_t group) {
    if (group >= program_.moving_groups || has_centres_[group] != 0) return;
    has_centres_[group] = 1;
    const BallGroup& of = program_.groups[group];
    for (std::size_t k = of.first; k < of.end; ++k)
      store(carried(of.body, program_.balls[k].centre), centres_at_ + 3 * k);
  }

  // Where something is in all lanes: computed, or standing still.
  static HWY_INLINE V3 still(const std::array<float, 3>& at) { return {set(at[0]), set(at[1]), set(at[2])}; }
  HWY_INLINE V3 centre(std::size_t ball) const {
    return ball < program_.moving_balls ? three(centres_at_ + 3 * ball) : still(program_.balls[ball].centre);
  }
  HWY_INLINE V3 middle_of_group(std::size_t group) const {
    return group < program_.moving_groups ? three(groups_at_ + 3 * group)
                                          : still(program_.groups[group].bound.centre);
  }
  HWY_INLINE V3 middle_of(std::size_t part) const {
    return part < program_.moving_parts ? three(middles_at_ + 3 * part)
                                        : still(program_.parts[part].bound.centre);
  }

  HWY_INLINE M near(const Solid& solid, const V3& at, float radius) const {
    const V x = hn::Sub(at[0], set(solid.centre[0])), y = hn::Sub(at[1], set(solid.centre[1])),
            z = hn::Sub(at[2], set(solid.centre[2]));
    if (solid.kind == Solid::Kind::Sphere) {
      const float sum = radius + solid.half[0];
      return hn::Le(square(x, y, z), set(sum * sum));
    }
    const V none = hn::Zero(Tag());
    const V3 l{sum_of(x, y, z, &solid.rows[0]), sum_of(x, y, z, &solid.rows[3]),
               sum_of(x, y, z, &solid.rows[6])};
    const V limit = set(radius * radius);
    if (solid.kind == Solid::Kind::Cylinder) {
      const V from_axis = hn::Sqrt(hn::Add(hn::Mul(l[0], l[0]), hn::Mul(l[1], l[1])));
      const V aside = hn::Max(hn::Sub(from_axis, set(solid.half[0])), none);
      const V along = hn::Max(hn::Sub(hn::Abs(l[2]), set(solid.half[1])), none);
      return hn::Le(hn::Add(hn::Mul(aside, aside), hn::Mul(along, along)), limit);
    }
    V3 out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = hn::Max(hn::Sub(hn::Abs(l[i]), set(solid.half[i])), none);
    return hn::Le(square(out[0], out[1], out[2]), limit);
  }

  HWY_INLINE void meet_world(std::size_t which, M& hit) {
    const Part& part = program_.parts[which];
    const V3 middle = middle_of(which);
    for (const std::uint32_t each : part.obstacles) {
      const Solid& solid = program_.solids[each];
      const M close = near(solid, middle, part.bound.radius);
      if (hn::AllFalse(Tag(), close)) continue;
      groups_of(which);
      for (std::size_t g = part.first_group; g < part.end_group; ++g) {
        const BallGroup& group = program_.groups[g];
        const M here = hn::And(close, near(solid, middle_of_group(g), group.bound.radius));
        if (hn::AllFalse(Tag(), here)) continue;
        centres_of(g);
        for (std::size_t k = group.first; k < group.end; ++k)
          hit = hn::Or(hit, hn::And(here, near(solid, centre(k), program_.balls[k].radius)));
      }
    }
  }

  static HWY_INLINE M touch(const V3& a, const V3& b, float sum) {
    return hn::Le(square(hn::Sub(a[0], b[0]), hn::Sub(a[1], b[1]), hn::Sub(a[2], b[2])), set(sum * sum));
  }

  HWY_INLINE void meet_groups(std::size_t which_a, std::size_t which_b, M close, M& hit) {
    const BallGroup &a = program_.groups[which_a], &b = program_.groups[which_b];
    centres_of(which_a);
    centres_of(which_b);
    const V3 middle = middle_of_group(which_b);
    for (std::size_t i = a.first; i < a.end; ++i) {
      const float radius = program_.balls[i].radius;
      const V3 at = centre(i);
      const M here = hn::And(close, touch(at, middle, radius + b.bound.radius));
      if (hn::AllFalse(Tag(), here)) continue;
      for (std::size_t k = b.first; k < b.end; ++k)
        hit = hn::Or(hit, hn::And(here, touch(at, centre(k), radius + program_.balls[k].radius)));
    }
  }

  // True if the links were looked at closely.
  HWY_INLINE bool meet(std::size_t which_a, std::size_t which_b, M& hit) {
    const Part &a = program_.parts[which_a], &b = program_.parts[which_b];
    const V3 middle = middle_of(which_b);
    const M close = touch(middle_of(which_a), middle, a.bound.radius + b.bound.radius);
    if (hn::AllFalse(Tag(), close)) return false;
    groups_of(which_a);
    groups_of(which_b);
    for (std::size_t ga = a.first_group; ga < a.end_group; ++ga) {
      const BallGroup& one = program_.groups[ga];
      const V3 at = middle_of_group(ga);
      const M here = hn::And(close, touch(at, middle, one.bound.radius + b.bound.radius));
      if (hn::AllFalse(Tag(), here)) continue;
      for (std::size_t gb = b.first_group; gb < b.end_group; ++gb) {
        const float radius = program_.groups[gb].bound.radius;
        const M both = hn::And(here, touch(at, middle_of_group(gb), one.bound.radius + radius));
        if (!hn::AllFalse(Tag(), both)) meet_groups(ga, gb, both, hit);
      }
    }
    return true;
  }

  const Program& program_;
  std::size_t lanes_;
  std::size_t columns_at_, middles_at_, groups_at_, centres_at_;
  hwy::AlignedFreeUniquePtr<float[]> vectors_;
  std::vector<std::uint8_t> has_groups_, has_centres_;  // of parts, of groups
};

void check_batches(const Program& program, const double* rows, std::size_t count, bool any,
                   std::uint8_t* collides) {
  Batch batch(program);
  for (std::size_t k = 0; k < count; k += batch.lanes()) {
    const std::size_t here = count - k < batch.lanes() ? count - k : batch.lanes();
    if (batch.check(rows + k * program.columns, here, any, collides + k) && any) return;
  }
}

std::size_t lanes_here() {
  return hn::Lanes(Tag());
}

}  // namespace HWY_NAMESPACE
}  // namespace stepwright::motion::internal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stepwright::motion::internal {

HWY_EXPORT(check_batches);
HWY_EXPORT(lanes_here);

void check_simd(const Program& program, const double* rows, std::size_t count, bool any,
                std::uint8_t* collides) {
  HWY_DYNAMIC_DISPATCH(check_batches)(program, rows, count, any, collides);
}

std::size_t simd_lanes() {
  return HWY_DYNAMIC_DISPATCH(lanes_here)();
}

std::vector<std::int64_t> simd_targets() {
  std::vector<std::int64_t> targets;
  for (std::int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all != 0; all &= all - 1)
    targets.push_back(all & -all);
  return targets;
}

void choose_simd_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
}

const char* simd_target_name(std::int64_t target) {
  return hwy::TargetName(target);
}

}  // namespace stepwright::motion::internal
#endif

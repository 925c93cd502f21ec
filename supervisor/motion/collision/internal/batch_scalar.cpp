// One configuration after the other, in plain arithmetic: the measure for batch_simd.cpp, which computes the
// same sums and products in the same order.

#include <algorithm>
#include <cmath>

#include "supervisor/motion/collision/internal/program.h"

namespace stepwright::motion::internal {

namespace {

struct Place {
  std::array<float, 9> r{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<float, 3> p{};
};

struct SineCosine {
  float sine, cosine;
};

SineCosine sine_cosine(float x) {
  const float k = std::floor(x * kTwoOverPi + 0.5F);
  const float r = ((x - k * kHalfPi[0]) - k * kHalfPi[1]) - k * kHalfPi[2];
  const float z = r * r;
  const float s = r + (r * z) * (((kSine[3] * z + kSine[2]) * z + kSine[1]) * z + kSine[0]);
  const float c = ((((kCosine[3] * z + kCosine[2]) * z + kCosine[1]) * z) + kCosine[0]) * z + 1.0F;
  const float quarter = k - 4.0F * std::floor(k * 0.25F);
  const bool odd = quarter == 1.0F || quarter == 3.0F;
  const float sine = odd ? c : s, cosine = odd ? s : c;
  return {quarter >= 2.0F ? -sine : sine, quarter == 1.0F || quarter == 2.0F ? -cosine : cosine};
}

std::array<float, 3> times(const std::array<float, 9>& r, const std::array<float, 3>& v) {
  return {(r[0] * v[0] + r[1] * v[1]) + r[2] * v[2], (r[3] * v[0] + r[4] * v[1]) + r[5] * v[2],
          (r[6] * v[0] + r[7] * v[1]) + r[8] * v[2]};
}

std::array<float, 3> carried(const Place& by, const std::array<float, 3>& v) {
  const auto turned = times(by.r, v);
  return {turned[0] + by.p[0], turned[1] + by.p[1], turned[2] + by.p[2]};
}

class One {
 public:
  explicit One(const Program& program) : program_(program), places_(program.steps.size() + 1) {}

  bool collides(const double* row) {
    place(row);
    for (std::size_t k = 0; k < program_.moving_parts; ++k)
      if (meets_world(program_.parts[k])) return true;
    return std::any_of(program_.pairs.begin(), program_.pairs.end(), [&](const auto& pair) {
      return meet(program_.parts[pair.first], program_.parts[pair.second]);
    });
  }

 private:
  void place(const double* row) {
    for (std::size_t k = 0; k < program_.steps.size(); ++k) {
      const BodyStep& step = program_.steps[k];
      const Place& parent = places_[step.parent];
      Place& at = places_[k + 1];
      const float value = static_cast<float>(row[step.column]) * step.multiplier + step.offset;
      std::array<float, 9> turned = step.still;
      std::array<float, 3> origin = step.origin;
      if (step.slides) {
        for (std::size_t i = 0; i < 3; ++i) origin[i] = origin[i] + value * step.along[i];
      } else {
        const auto [s, c] = sine_cosine(value);
        for (std::size_t i = 0; i < 9; ++i)
          turned[i] = (turned[i] + c * step.with_cosine[i]) + s * step.with_sine[i];
      }
      for (std::size_t row_of = 0; row_of < 3; ++row_of)
        for (std::size_t i = 0; i < 3; ++i)
          at.r[3 * row_of + i] =
              (parent.r[3 * row_of] * turned[i] + parent.r[3 * row_of + 1] * turned[3 + i]) +
              parent.r[3 * row_of + 2] * turned[6 + i];
      at.p = carried(parent, origin);
    }
  }

  bool near(const Solid& solid, const std::array<float, 3>& centre, float radius) const {
    const std::array<float, 3> d{centre[0] - solid.centre[0], centre[1] - solid.centre[1],
                                 centre[2] - solid.centre[2]};
    if (solid.kind == Solid::Kind::Sphere) {
      const float sum = radius + solid.half[0];
      return (d[0] * d[0] + d[1] * d[1]) + d[2] * d[2] <= sum * sum;
    }
    const auto l = times(solid.rows, d);
    const auto beyond = [](float value, float half) { return std::max(value - half, 0.0F); };
    if (solid.kind == Solid::Kind::Cylinder) {
      const float aside = beyond(std::sqrt(l[0] * l[0] + l[1] * l[1]), solid.half[0]);
      const float along = beyond(std::abs(l[2]), solid.half[1]);
      return aside * aside + along * along <= radius * radius;
    }
    const float x = beyond(std::abs(l[0]), solid.half[0]), y = beyond(std::abs(l[1]), solid.half[1]),
                z = beyond(std::abs(l[2]), solid.half[2]);
    return (x * x + y * y) + z * z <= radius * radius;
  }

  bool meets_world(const Part& part) {
    const auto middle = carried(places_[part.body], part.bound.centre);
    return std::any_of(part.obstacles.begin(), part.obstacles.end(), [&](std::uint32_t which) {
      const Solid& solid = program_.solids[which];
      if (!near(solid, middle, part.bound.radius)) return false;
      for (std::size_t k = part.first; k < part.end; ++k)
        if (near(solid, carried(places_[part.body], program_.balls[k].centre), program_.balls[k].radius))
          return true;
      return false;
    });
  }

  static bool touch(const std::array<float, 3>& a, float ra, const std::array<float, 3>& b, float rb) {
    const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2], sum = ra + rb;
    return (x * x + y * y) + z * z <= sum * sum;
  }

  bool meet(const Part& a, const Part& b) {
    const Place &at_a = places_[a.body], &at_b = places_[b.body];
    const auto middle = carried(at_b, b.bound.centre);
    if (!touch(carried(at_a, a.bound.centre), a.bound.radius, middle, b.bound.radius)) return false;
    for (std::size_t i = a.first; i < a.end; ++i) {
      const auto centre = carried(at_a, program_.balls[i].centre);
      if (!touch(centre, program_.balls[i].radius, middle, b.bound.radius)) continue;
      for (std::size_t k = b.first; k < b.end; ++k)
        if (touch(centre, program_.balls[i].radius, carried(at_b, program_.balls[k].centre),
                  program_.balls[k].radius))
          return true;
    }
    return false;
  }

  const Program& program_;
  std::vector<Place> places_;
};

}  // namespace

void check_scalar(const Program& program, const double* rows, std::size_t count, bool any,
                  std::uint8_t* collides) {
  One one(program);
  for (std::size_t k = 0; k < count; ++k) {
    collides[k] = one.collides(rows + k * program.columns);
    if (any && collides[k] != 0) return;
  }
}

}  // namespace stepwright::motion::internal

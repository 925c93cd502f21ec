#include "supervisor/motion/spheres/enclosing_sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace stepwright::motion {

namespace {

// The sphere through one to four points whose centre is in their span; false where they lie degenerate.
bool sphere_through(std::span<const Vector3> on, Sphere& out) {
  // Centre = p0 + sum k_i d_i with 2 d_i . (sum k_j d_j) = d_i . d_i.
  const std::size_t n = on.size() - 1;
  std::array<Vector3, 3> d{};
  std::array<std::array<double, 4>, 3> m{};
  for (std::size_t i = 0; i < n; ++i) d[i] = on[i + 1] - on[0];
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) m[i][j] = 2.0 * dot(d[i], d[j]);
    m[i][3] = dot(d[i], d[i]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i + 1; r < n; ++r)
      if (std::abs(m[r][i]) > std::abs(m[pivot][i])) pivot = r;
    std::swap(m[i], m[pivot]);
    if (!(std::abs(m[i][i]) > 1e-14 * (dot(d[0], d[0]) + 1e-300))) return false;
    for (std::size_t r = 0; r < n; ++r) {
      if (r == i) continue;
      const double k = m[r][i] / m[i][i];
      for (std::size_t c = i; c < n; ++c) m[r][c] -= k * m[i][c];
      m[r][3] -= k * m[i][3];
    }
  }
  Vector3 aside;
  for (std::size_t i = 0; i < n; ++i) aside += (m[i][3] / m[i][i]) * d[i];
  out = {on[0] + aside, length(aside)};
  return true;
}

// The smallest sphere around up to five points, by all choices of those that lie on it.
Sphere smallest_of_few(std::span<const Vector3> points, std::vector<Vector3>& carriers) {
  Sphere best{{}, -1.0};
  std::array<Vector3, 4> on;
  for (unsigned choice = 1; choice < (1U << points.size()); ++choice) {
    std::size_t count = 0;
    bool small = true;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (choice & (1U << k)) {
        if (count == on.size())
          small = false;
        else
          on[count++] = points[k];
      }
    Sphere tried;
    if (!small || !sphere_through(std::span(on).first(count), tried)) continue;
    if (best.radius_m >= 0.0 && tried.radius_m >= best.radius_m) continue;
    const double reach = tried.radius_m * (1.0 + 1e-10) + 1e-15;
    if (std::all_of(points.begin(), points.end(),
                    [&](Vector3 p) { return distance(p, tried.centre_m) <= reach; })) {
      best = tried;
      carriers.assign(on.begin(), on.begin() + static_cast<std::ptrdiff_t>(count));
    }
  }
  return best;
}

}  // namespace

Sphere enclosing_sphere(std::span<const Vector3> points) {
  if (points.empty()) return {};
  std::vector<Vector3> carriers{points[0]};
  Sphere sphere{points[0], 0.0};
  constexpr int kMostExchanges = 100;
  double farthest = 0.0;
  for (int k = 0; k <= kMostExchanges; ++k) {
    Vector3 far = points[0];
    farthest = -1.0;
    for (const Vector3& each : points)
      if (const double away = distance(each, sphere.centre_m); away > farthest) farthest = away, far = each;
    if (farthest <= sphere.radius_m * (1.0 + 1e-9) + 1e-14 || k == kMostExchanges) break;
    std::vector<Vector3> few = carriers;
    few.push_back(far);
    const Sphere next = smallest_of_few(few, carriers);
    if (!(next.radius_m > sphere.radius_m)) break;  // rounding: it does not grow any more
    sphere = next;
  }
  // What exchange and rounding left outside is taken in.
  sphere.radius_m = farthest * (1.0 + 1e-12) + 1e-12;
  return sphere;
}

}  // namespace stepwright::motion

#include "supervisor/tamp/pictures/mesh_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace stepwright::tamp::pictures {
namespace {

using motion::TriangleMesh;
using motion::Vector3;

struct Bounds {
  Vector3 low, high;
};

Bounds bounds_of(const TriangleMesh& mesh) {
  Bounds all{mesh.points.front(), mesh.points.front()};
  for (const Vector3 p : mesh.points) {
    all.low = {std::min(all.low.x, p.x), std::min(all.low.y, p.y), std::min(all.low.z, p.z)};
    all.high = {std::max(all.high.x, p.x), std::max(all.high.y, p.y), std::max(all.high.z, p.z)};
  }
  return all;
}

// So many cells along the longest side.
TriangleMesh clustered(const TriangleMesh& mesh, const Bounds& bounds, int cells) {
  const Vector3 size = bounds.high - bounds.low;
  const double side_m = std::max({size.x, size.y, size.z, 1e-9}) / cells;
  struct Cluster {
    std::uint32_t number = 0;
    Vector3 sum;
    double count = 0.0;
  };
  std::map<std::array<int, 3>, Cluster> clusters;
  std::vector<std::uint32_t> number_of;
  for (const Vector3 p : mesh.points) {
    const Vector3 off = (1.0 / side_m) * (p - bounds.low);
    Cluster& one =
        clusters
            .try_emplace({static_cast<int>(off.x), static_cast<int>(off.y), static_cast<int>(off.z)},
                         Cluster{.number = static_cast<std::uint32_t>(clusters.size()), .sum = {}})
            .first->second;
    one.sum += p;
    one.count += 1.0;
    number_of.push_back(one.number);
  }
  TriangleMesh made;
  made.points.resize(clusters.size());
  for (const auto& [cell, one] : clusters) made.points[one.number] = (1.0 / one.count) * one.sum;
  std::set<std::array<std::uint32_t, 3>> known;
  for (const auto& [a, b, c] : mesh.triangles) {
    std::array<std::uint32_t, 3> t{number_of[a], number_of[b], number_of[c]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    std::ranges::rotate(t, std::ranges::min_element(t));
    if (known.insert(t).second) made.triangles.push_back(t);
  }
  return made;
}

}  // namespace

TriangleMesh few_faces(const TriangleMesh& mesh, std::size_t most) {
  if (mesh.triangles.size() <= most || mesh.points.empty()) return mesh;
  const Bounds bounds = bounds_of(mesh);
  TriangleMesh best = clustered(mesh, bounds, 1);
  for (int cells = 2; cells <= 64; ++cells) {
    TriangleMesh finer = clustered(mesh, bounds, cells);
    if (finer.triangles.size() > most) break;
    best = std::move(finer);
  }
  return best;
}

}  // namespace stepwright::tamp::pictures

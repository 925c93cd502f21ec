#pragma once

// A body cut by planes along x, y and z into pieces, each known by points whose hull contains it: the corners
// of the surface within its cell, and those corners of the cell that are inside of the body.
//
// Why that is enough: a direction's farthest point of the piece is on the surface, or it is inside of the
// body on the border of the cell, and then it can be moved along that border, not back, until it is on the
// surface or at a corner.
//
//   const BodyPieces cutter(mesh);
//   auto [low, high] = cutter.cut(cutter.whole(), 2, 0.1);
//
// Refers to the mesh that it was made of. Does not change after it was made; any thread.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "supervisor/motion/mesh/triangle_mesh.h"

namespace stepwright::motion {

struct BodyPiece {
  std::array<double, 3> low{}, high{};      // its cell
  std::vector<Vector3> corners;             // of polygons, one after the other
  std::vector<std::uint32_t> polygon_ends;  // where each polygon ends in `corners`
  std::array<bool, 8> inside{};             // corner k of the cell: bit 0, 1, 2 of k: high in x, y, z

  bool empty() const;
  // The points whose hull contains the piece.
  std::vector<Vector3> points() const;
  Vector3 cell_corner(unsigned k) const;
};

class BodyPieces {
 public:
  explicit BodyPieces(const TriangleMesh& mesh) : mesh_(mesh) {}

  BodyPiece whole() const;
  // Below and above the plane on which coordinate `axis` (0 to 2) is `at_m`, which goes through the cell.
  std::pair<BodyPiece, BodyPiece> cut(const BodyPiece& piece, std::size_t axis, double at_m) const;

 private:
  bool is_inside(Vector3 point) const;

  const TriangleMesh& mesh_;
};

}  // namespace stepwright::motion

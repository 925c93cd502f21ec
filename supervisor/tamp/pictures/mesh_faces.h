#pragma once

// A mesh with few triangles, for drawings. A pure function; any thread.

#include <cstddef>

#include "supervisor/motion/mesh/triangle_mesh.h"

namespace stepwright::tamp::pictures {

// Points that lie in one cell of a grid become one, and triangles without an area go; the grid is as fine as
// `most` triangles allow (Rossignac, Borrel 1993, Multi-resolution 3D approximations for rendering complex
// scenes). A mesh with no more triangles stays as it is.
motion::TriangleMesh few_faces(const motion::TriangleMesh& mesh, std::size_t most);

}  // namespace stepwright::tamp::pictures

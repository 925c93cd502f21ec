#pragma once

// Files of meshes (STL, OBJ, DAE, PLY and what else the library assimp reads), as triangles.
//
//   const auto mesh = read_mesh("link0.stl", {0.001, 0.001, 0.001});
//
// A function without state; any thread. Sizes are bounded: files of 64 MiB, a million triangles. Triangles
// without an area are left out, and all point outwards where the body is closed.

#include <filesystem>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/mesh/triangle_mesh.h"

namespace stepwright::motion {

namespace code {
inline constexpr const char* kBadMesh =
    "A0201";  // a mesh that cannot be read, is too large or has no triangle
}

inline constexpr std::uintmax_t kMostMeshBytes = std::uintmax_t{64} << 20U;
inline constexpr std::size_t kMostTriangles = 1'000'000;

// Fails with A0201.
[[nodiscard]] result::Result<TriangleMesh> read_mesh(const std::filesystem::path& file,
                                                     Vector3 scale = {1, 1, 1});

}  // namespace stepwright::motion

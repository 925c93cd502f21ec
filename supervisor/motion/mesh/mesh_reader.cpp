#include "supervisor/motion/mesh/mesh_reader.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <system_error>

namespace stepwright::motion {

namespace {

// Triangles of a file with all of its nodes' places; false: too many.
bool add_node(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above, Vector3 scale, int depth,
              TriangleMesh& out) {
  constexpr int kDeepest = 64;
  if (depth > kDeepest) return false;
  const aiMatrix4x4 place = above * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    const auto first = static_cast<std::uint32_t>(out.points.size());
    if (out.points.size() + mesh.mNumVertices > 3 * kMostTriangles ||
        out.triangles.size() + mesh.mNumFaces > kMostTriangles)
      return false;
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
      const aiVector3D point = place * mesh.mVertices[k];
      out.points.push_back({scale.x * static_cast<double>(point.x), scale.y * static_cast<double>(point.y),
                            scale.z * static_cast<double>(point.z)});
    }
    for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
      const aiFace& face = mesh.mFaces[k];
      if (face.mNumIndices != 3) continue;  // points and lines have no surface
      std::array<std::uint32_t, 3> triangle{};
      bool sound = true;
      for (unsigned c = 0; c < 3; ++c) {
        sound = sound && face.mIndices[c] < mesh.mNumVertices;
        triangle[c] = first + face.mIndices[c];
      }
      if (sound) out.triangles.push_back(triangle);
    }
  }
  for (unsigned k = 0; k < node.mNumChildren; ++k)
    if (!add_node(scene, *node.mChildren[k], place, scale, depth + 1, out)) return false;
  return true;
}

}  // namespace

result::Result<TriangleMesh> read_mesh(const std::filesystem::path& file, Vector3 scale) {
  const auto refuse = [&](std::string message, std::string hint = {}) {
    return result::fail(code::kBadMesh, {file.string()}, std::move(message), std::move(hint));
  };
  std::error_code problem;
  const std::uintmax_t bytes = std::filesystem::file_size(file, problem);
  if (problem) return refuse("the mesh cannot be read: " + problem.message());
  if (bytes > kMostMeshBytes)
    return refuse("the mesh is larger than 64 MiB", "collisions need no fine meshes");
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  if (!scene || !scene->mRootNode)
    return refuse(std::string("the mesh cannot be read: ") + importer.GetErrorString(),
                  "STL, OBJ, DAE and PLY are read");
  TriangleMesh mesh;
  if (!add_node(*scene, *scene->mRootNode, {}, scale, 0, mesh))
    return refuse("the mesh has more than a million triangles", "collisions need no fine meshes");
  for (const Vector3& each : mesh.points)
    if (!is_finite(each)) return refuse("the mesh has a point that is not finite");
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return !(area_m2({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}) > 0.0);
  });
  if (mesh.triangles.empty()) return refuse("the mesh has no triangle with an area");
  turn_outwards(mesh);
  return mesh;
}

}  // namespace stepwright::motion

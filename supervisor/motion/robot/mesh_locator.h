#pragma once

// Finds the files of meshes that URDF names: "package://PACKAGE/PATH", "file:///PATH", or relative to the
// URDF.
//
//   MeshLocator meshes("robots/panda");                        // the folder of the URDF
//   meshes.map("package://panda_description", "third_party/panda");
//   const auto file = meshes.find("package://panda_description/meshes/link0.stl");
//
// A value; any thread may call find(). No package index of ROS is asked: a name whose beginning is mapped is
// looked for there; else PACKAGE/PATH and PATH are looked for beside the URDF and in each folder above it.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runtime/ground/result/result.h"

namespace stepwright::motion {

class MeshLocator {
 public:
  explicit MeshLocator(std::filesystem::path urdf_folder) : folder_(std::move(urdf_folder)) {}

  // Names that begin with `beginning`, whole parts of it, are in `folder`; of several the longest counts.
  void map(std::string beginning, std::filesystem::path folder);

  // Fails with A0110, which names the places that were looked at.
  [[nodiscard]] result::Result<std::filesystem::path> find(const std::string& name) const;

 private:
  std::filesystem::path folder_;
  std::vector<std::pair<std::string, std::filesystem::path>> mapped_;
};

}  // namespace stepwright::motion

#include "supervisor/motion/robot/mesh_locator.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace stepwright::motion {
namespace {

namespace fs = std::filesystem;

class MeshLocatorFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* file : {"robots/arm/urdf/near.stl", "robots/arm/meshes/link.stl",
                             "robots/pack/meshes/far.stl", "elsewhere/meshes/other.stl"}) {
      fs::create_directories((folder_ / file).parent_path());
      std::ofstream(folder_ / file) << "solid";
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string found(const MeshLocator& meshes, const std::string& name) {
    const auto file = meshes.find(name);
    return file ? file->lexically_relative(folder_).string() : file.error().front().code;
  }

  fs::path folder_ = fs::temp_directory_path() / ("stepwright_meshes_" + std::to_string(getpid()));
};

TEST_F(MeshLocatorFiles, WhenANameIsRelativeOrAFile_ThenItIsFoundThere) {
  const MeshLocator meshes(folder_ / "robots/arm/urdf");
  EXPECT_EQ(found(meshes, "near.stl"), "robots/arm/urdf/near.stl");
  EXPECT_EQ(found(meshes, "file://" + (folder_ / "robots/arm/urdf/near.stl").string()),
            "robots/arm/urdf/near.stl");
  EXPECT_EQ(found(meshes, "missing.stl"), "A0110");
  EXPECT_EQ(found(meshes, ""), "A0110");
}

TEST_F(MeshLocatorFiles, WhenAPackageIsBesideTheRobotOrAboveIt_ThenItIsFound) {
  const MeshLocator meshes(folder_ / "robots/arm/urdf");
  EXPECT_EQ(found(meshes, "package://arm/meshes/link.stl"), "robots/arm/meshes/link.stl");
  EXPECT_EQ(found(meshes, "package://any_name/meshes/link.stl"), "robots/arm/meshes/link.stl");
  EXPECT_EQ(found(meshes, "package://pack/meshes/far.stl"), "robots/pack/meshes/far.stl");
  EXPECT_EQ(found(meshes, "package://pack/meshes/none.stl"), "A0110");
  EXPECT_EQ(found(meshes, "package://"), "A0110");
}

TEST_F(MeshLocatorFiles, WhenABeginningIsMapped_ThenOnlyThatFolderCounts) {
  MeshLocator meshes(folder_ / "robots/arm/urdf");
  meshes.map("package://pack", folder_ / "elsewhere");
  meshes.map("package://pack/deep", folder_ / "elsewhere/meshes");
  EXPECT_EQ(found(meshes, "package://pack/meshes/other.stl"), "elsewhere/meshes/other.stl");
  EXPECT_EQ(found(meshes, "package://pack/deep/other.stl"), "elsewhere/meshes/other.stl");
  EXPECT_EQ(found(meshes, "package://pack/meshes/far.stl"), "A0110");
  EXPECT_EQ(found(meshes, "package://package/meshes/link.stl"),
            "robots/arm/meshes/link.stl");  // another name
  EXPECT_EQ(found(meshes, "package://arm/meshes/link.stl"), "robots/arm/meshes/link.stl");
}

}  // namespace
}  // namespace stepwright::motion

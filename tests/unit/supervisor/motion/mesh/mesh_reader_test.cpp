#include "supervisor/motion/mesh/mesh_reader.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "supervisor/motion/mesh/link_meshes.h"
#include "tests/unit/supervisor/motion/robots.h"

namespace stepwright::motion {
namespace {

namespace fs = std::filesystem;

class MeshFiles : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  fs::path folder_ = fs::temp_directory_path() / ("stepwright_mesh_files_" + std::to_string(getpid()));
};

// A tetrahedron; its faces as given point outwards, or inwards.
std::string tetrahedron(bool inside_out) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  for (const char* face : {"1 3 2", "1 2 4", "1 4 3", "2 3 4"}) {
    std::string corners = face;
    if (inside_out) std::swap(corners[0], corners[2]);
    text += "f " + corners + "\n";
  }
  return text;
}

TEST_F(MeshFiles, WhenAFileIsSound_ThenItsTrianglesAreScaledAndPointOutwards) {
  for (const bool inside_out : {false, true}) {
    const auto mesh = read_mesh(write("t.obj", tetrahedron(inside_out)), {0.001, 0.001, 0.001});
    ASSERT_TRUE(mesh) << to_string(mesh.error());
    EXPECT_EQ(mesh->triangles.size(), 4u);
    EXPECT_NEAR(winding_number(*mesh, {1e-4, 1e-4, 1e-4}), 1.0, 1e-6);
    for (const Vector3& each : mesh->points) EXPECT_LE(length(each), 0.001 + 1e-9);
  }
  // A mirrored mesh has its surface the right way round, too.
  const auto mirrored = read_mesh(write("t.obj", tetrahedron(false)), {-1, 1, 1});
  ASSERT_TRUE(mirrored);
  EXPECT_NEAR(winding_number(*mirrored, {-0.1, 0.1, 0.1}), 1.0, 1e-6);
}

TEST_F(MeshFiles, WhenAFileIsWrong_ThenItIsRefusedByName) {
  const auto code_of = [](const fs::path& file) {
    const auto mesh = read_mesh(file);
    if (mesh) return std::string("none");
    EXPECT_EQ(mesh.error()[0].where.file, file.string());
    return mesh.error()[0].code;
  };
  EXPECT_EQ(code_of(folder_ / "none.obj"), "A0201");
  EXPECT_EQ(code_of(folder_), "A0201");
  EXPECT_EQ(code_of(write("empty.stl", "")), "A0201");
  EXPECT_EQ(code_of(write("cut.stl", std::string(90, '\xff'))), "A0201");
  EXPECT_EQ(code_of(write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")), "A0201");
}

TEST_F(MeshFiles, WhenLinksNameMeshes_ThenEachFileIsReadOnceAndMissingOnesAreTold) {
  write("t.obj", tetrahedron(false));
  const auto body = [](const std::string& file) {
    return "<collision><geometry><mesh filename='" + file + "'/></geometry></collision>";
  };
  const auto robot = read_urdf("<robot name='r'><link name='a'>" + body("t.obj") + body("package://p/t.obj") +
                                   body("t.obj") + "</link></robot>",
                               "r.urdf");
  ASSERT_TRUE(robot) << to_string(robot.error());
  const auto bodies = read_bodies(*robot, MeshLocator(folder_));
  ASSERT_TRUE(bodies) << to_string(bodies.error());
  EXPECT_EQ((*bodies)[0][0].mesh, (*bodies)[0][2].mesh);
  EXPECT_EQ((*bodies)[0][1].mesh->triangles.size(), 4u);
  const auto missing =
      read_urdf("<robot name='r'><link name='a'>" + body("x.obj") + body("y.obj") + "</link></robot>", "r");
  EXPECT_EQ(read_bodies(*missing, MeshLocator(folder_)).error().size(), 2u);
}

TEST_F(MeshFiles, WhenAMeshIsNotFound_ThenBodiesOfTheOtherDescriptionStandForItAndItIsSaid) {
  const auto link = [](const std::string& name, const std::string& shape) {
    return "<link name='" + name + "'><collision><geometry>" + shape + "</geometry></collision></link>";
  };
  const std::string joint = "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>";
  const auto robot = read_urdf("<robot name='r'>" + link("a", "<mesh filename='none.stl'/>") +
                                   link("b", "<mesh filename='gone.stl'/>") + joint + "</robot>",
                               "r");
  const auto other = [&](const std::string& of_b) {
    return *read_urdf(
        "<robot name='r'>" + link("a", "<sphere radius='0.1'/>") + link("b", of_b) + joint + "</robot>", "o");
  };
  result::Diagnostics noted;
  const auto bodies = read_bodies(*robot, MeshLocator(folder_), other("<box size='1 1 1'/>"), noted);
  ASSERT_TRUE(bodies) << to_string(bodies.error());
  EXPECT_EQ((*bodies)[0].at(0).shape.radius_m, 0.1);
  EXPECT_EQ((*bodies)[1].at(0).shape.kind, ShapeKind::Box);
  ASSERT_EQ(noted.size(), 2u);
  EXPECT_EQ(noted[1].code, "A0112");
  EXPECT_NE(noted[1].message.find("'gone.stl' of link 'b'"), std::string::npos);
  const auto refused = read_bodies(*robot, MeshLocator(folder_), other("<mesh filename='gone.stl'/>"), noted);
  ASSERT_FALSE(refused) << "a mesh that is not found either stands for nothing";
  EXPECT_EQ(refused.error().size(), 1u);
}

TEST_F(MeshFiles, WhenARobotOfOthersIsThere_ThenItsMeshesAreRead) {
  const auto panda = tests::data_of_others("arms/panda/panda.urdf");
  if (!panda) GTEST_SKIP() << "data/arms is not on this machine";
  const Robot robot = tests::robot_of(*panda);
  const auto bodies = read_bodies(robot, MeshLocator(panda->parent_path()));
  ASSERT_TRUE(bodies) << to_string(bodies.error());
  EXPECT_GT((*bodies)[0].at(0).mesh->triangles.size(), 100u);
}

}  // namespace
}  // namespace stepwright::motion

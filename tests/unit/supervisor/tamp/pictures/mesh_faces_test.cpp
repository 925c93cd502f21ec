#include "supervisor/tamp/pictures/mesh_faces.h"

#include <gtest/gtest.h>

#include "supervisor/motion/mesh/solids.h"

namespace stepwright::tamp::pictures {
namespace {

TEST(MeshFaces, WhenAMeshHasFew_ThenItStaysAsItIs) {
  const motion::TriangleMesh box = motion::box_mesh({1, 2, 3});
  EXPECT_EQ(few_faces(box, 12).triangles, box.triangles);
}

TEST(MeshFaces, WhenAMeshHasMany_ThenFewThatEncloseTheSame) {
  const motion::TriangleMesh fine = motion::prism_around_cylinder(0.1, 0.4, 400);
  ASSERT_GT(fine.triangles.size(), 1000u);
  const motion::TriangleMesh few = few_faces(fine, 160);
  EXPECT_LE(few.triangles.size(), 160u);
  EXPECT_GE(few.triangles.size(), 30u);
  for (const auto& triangle : few.triangles)
    for (const std::uint32_t point : triangle) ASSERT_LT(point, few.points.size());
  for (const double z : {-0.15, 0.0, 0.15}) {
    EXPECT_GT(motion::winding_number(few, {0, 0, z}), 0.9) << "outwards as before, and closed";
    EXPECT_LT(motion::winding_number(few, {0.13, 0, z}), 0.1);
  }
}

}  // namespace
}  // namespace stepwright::tamp::pictures

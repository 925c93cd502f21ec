#include "supervisor/vehicle/data_tables.h"

#include <gtest/gtest.h>

#include "supervisor/vehicle/literals.h"

namespace stepwright::vehicle {
namespace {

TEST(Literals, WhenNumbersAreWritten_ThenTheyAreRealsOfTheStandard) {
  EXPECT_EQ(real_literal(3), "3.0");
  EXPECT_EQ(real_literal(-2.5), "-2.5");
  EXPECT_EQ(real_literal(-0.0), "0.0");
  EXPECT_EQ(real_literal(1e-7), "1.0e-07");
  EXPECT_EQ(time_literal(std::chrono::milliseconds(250)), "T#250ms");
  EXPECT_EQ(time_literal(std::chrono::seconds(90)), "T#90s");
}

TEST(DataTables, WhenContentDiffers_ThenSoDoNames) {
  std::vector<PathSample> samples(2);
  samples[1].arc_m = 1.0;
  const graphic::Variable first = path_table("v1", samples, "the way");
  EXPECT_EQ(first.type, "ARRAY[0..1] OF MC_PATH_POINT");
  EXPECT_EQ(first.name, path_table("v1", samples, "another comment").name);
  samples[1].arc_m = 1.5;
  EXPECT_NE(first.name, path_table("v1", samples, "the way").name);
}

}  // namespace
}  // namespace stepwright::vehicle

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "hmi_web/drawing/drawing_file.h"

namespace stepwright::drawing {
namespace {

using testing::HasSubstr;

// A drawing of one rectangle with these attributes in its second line.
result::Result<Drawing> with(const std::string& attributes) {
  return read_drawing("plant.svg", "<svg viewBox='0 0 9 9'>\n<rect " + attributes + "/></svg>");
}

TEST(DrawingBindings, WhenAnElementHasSeveral_ThenAllAreCounted) {
  const auto drawing =
      with(R"(data-fill="a1.level" data-from="0" data-to="1.5" data-alarm="!Main.ok" data-digits="2")");
  ASSERT_TRUE(drawing) << result::to_string(drawing.error());
  EXPECT_EQ(drawing->bindings, 2U);
  EXPECT_THAT(drawing->svg, HasSubstr(R"(data-fill="a1.level")"));
  EXPECT_THAT(drawing->svg, HasSubstr(R"(data-to="1.5")"));
}

struct Wrong {
  const char* attributes;
  const char* message;
};

class WrongBinding : public testing::TestWithParam<Wrong> {};

TEST_P(WrongBinding, WhenItIsRead_ThenItsLineAndAHintAreTold) {
  const auto drawing = with(GetParam().attributes);
  ASSERT_FALSE(drawing);
  const result::Diagnostic& first = drawing.error().front();
  EXPECT_EQ(first.code, "C0643");
  EXPECT_EQ(first.where.line, 2U);
  EXPECT_THAT(first.message, HasSubstr(GetParam().message));
  EXPECT_FALSE(first.hint.empty());
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongBinding,
    testing::Values(Wrong{R"(data-text="")", "not the name"}, Wrong{R"(data-on="!")", "not the name"},
                    Wrong{R"(data-text="two names")", "not the name"},
                    Wrong{R"(data-fill="a" data-from="low")", "no number"},
                    Wrong{R"(data-fill="a" data-to="1e999")", "no number"},
                    Wrong{R"(data-fill="a" data-from="3" data-to="3")", "the same"},
                    Wrong{R"(data-move="a" data-x="5")", "needs data-y"},
                    Wrong{R"(data-turn="a")", "needs data-degrees"},
                    Wrong{R"(data-text="a" data-digits="1.5")", "0 to 6"},
                    Wrong{R"(data-fill="a" data-turn="b" data-degrees="90")", "one of"},
                    Wrong{R"(data-pose-x="v.x" data-floor-scale="9")", "needs data-pose-y"},
                    Wrong{R"(data-pose-y="v.y" data-floor-scale="9")", "needs data-pose-x"},
                    Wrong{R"(data-pose-heading="v.h" data-floor-scale="9")", "needs data-pose-x"},
                    Wrong{R"(data-pose-x="v.x" data-pose-y="v.y")", "needs data-floor-scale"},
                    Wrong{R"(data-pose-x="v.x" data-pose-y="v.y" data-floor-scale="0")", "more than 0"},
                    Wrong{R"(data-pose-x="v.x" data-pose-y="v.y" data-floor-scale="wide")", "no number"},
                    Wrong{R"(data-pose-x="v.x" data-pose-y="v.y" data-floor-scale="9" data-fill="a")",
                          "one of"},
                    Wrong{R"(data-show="pallet ")", "not the name"},
                    Wrong{R"(data-show="pallet p 1.state")", "not the name"},
                    Wrong{R"(data-show="lorry p1.state")", "not the name"}));

TEST(DrawingBindings, WhenAVehicleHasAPose_ThenTheScaleOfItsFloorMayStandAroundIt) {
  const auto drawing = read_drawing(
      "hall.svg",
      "<svg viewBox='0 0 9 9'><g data-floor-scale='20' data-floor-x='1.5' data-floor-y='-300'>"
      "<g data-pose-x='v1.x' data-pose-y='v1.y' data-pose-heading='v1.heading'><rect "
      "data-on='v1.loaded'/></g>"
      "<rect data-pose-x='pallet p1.x' data-pose-y='pallet p1.y' data-show='pallet p1.state'/></g></svg>");
  ASSERT_TRUE(drawing) << result::to_string(drawing.error());
  EXPECT_EQ(drawing->bindings, 7U);
  EXPECT_THAT(drawing->svg, HasSubstr(R"(data-floor-y="-300")"));
  EXPECT_THAT(drawing->svg, HasSubstr(R"(data-pose-x="pallet p1.x")"));
}

}  // namespace
}  // namespace stepwright::drawing

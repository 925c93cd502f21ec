#include <gtest/gtest.h>

#include <string>

#include "supervisor/tamp/pictures/arms_picture.h"

namespace stepwright::tamp::pictures {
namespace {

ArmsPicture small_cell() {
  ArmsPicture picture{.id = "cell", .program = "ab"};
  picture.frames.push_back({.name = "base"});
  picture.frames.push_back({.name = "link",
                            .parent = 0,
                            .arm = 0,
                            .motion = ArmsPicture::Motion::Turns,
                            .value = {.variable = "q"}});
  picture.frames[1].place.at_m = {0.1234567, 0.0, 0.0};
  picture.frames[1].solids.push_back({.kind = PictureSolid::Kind::Ball, .radius_m = 0.05});
  ArmsPicture::Arm arm{.name = "left", .joints = {{"j1", 1}}, .tool = 1, .progress = "p"};
  arm.steps.push_back({.kind = "grip", .thing = "cup", .waits = {{.at = 0.25, .other = 1, .progress = 2.0}}});
  arm.way.push_back({{1.0, 2.0, 3.0}, 0.5});
  picture.arms.push_back(arm);
  picture.things.push_back(
      {.name = "cup", .solids = {}, .stages = {{}, {.arm = 0, .from = 1.0, .frame = 1}}});
  picture.things[0].stages[1].place.rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  return picture;
}

// As the page gets it.
std::string written(const ArmsPicture& picture) {
  return run::to_json({.own = {page_picture(picture)}});
}

TEST(ArmsPictureJson, WhenACellOfArmsIsWritten_ThenInMicrometresAndRowsOfRotations) {
  const std::string text = written(small_cell());
  for (const char* part :
       {R"("kind":"arms")", R"("place":[0.123457,0.0,0.0])", R"("motion":"turns")", R"("axis":[0.0,0.0,1.0])",
        R"({"kind":"ball","place":[0.0,0.0,0.0],"radius_m":0.05})", R"("ways":[[[1.0,2.0,3.0,0.5]]])",
        R"("waits":[{"at":0.25,"other":1,"progress":2.0}])",
        R"("place":[0.0,0.0,0.0,0.0,-1.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0])"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

TEST(ArmsPictureJson, WhenWaysOfArmsAreTooLong_ThenTheyAreLeftOutAndThatIsSaid) {
  ArmsPicture picture = small_cell();
  picture.arms[0].way.assign(60'000, {{1.23456, 1.23456, 1.23456}, 0.5});
  const std::string text = written(picture);
  EXPECT_LT(text.size(), 3'000u);
  EXPECT_NE(text.find(R"("left_out":["ways"])"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("tool":1)"), std::string::npos) << "all else is there";
}

}  // namespace
}  // namespace stepwright::tamp::pictures

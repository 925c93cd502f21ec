#include "supervisor/run/picture.h"

#include <gtest/gtest.h>

#include <string>

#include "runtime/dds/plan_channel.h"

namespace stepwright::run {
namespace {

PictureRing square(double at) {
  return {{at, 0.0}, {at + 1.00049, 0.0}, {at + 1.0, 1.0}, {at, 1.0}};
}

TEST(Picture, WhenAFloorIsWritten_ThenInMetresAndMillimetres) {
  Pictures pictures;
  pictures.floors.push_back({.id = "hall", .program = "ab", .border = square(0.0), .progress = "arc"});
  pictures.floors[0].places.push_back({.area = {"press", square(2.0)}, .at = "at_press"});
  pictures.floors[0].way.push_back({.at = {1.0, 2.0}, .arc_m = 0.25, .reverse = true});
  const std::string text = to_json(pictures);
  for (const char* part : {R"("kind":"floor")", R"("border_m":[[0.0,0.0],[1.0,0.0],[1.0,1.0],[0.0,1.0]])",
                           R"("at":"at_press")", R"("way":[[1.0,2.0,0.25,-1]])", R"("left_out":[])"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

TEST(Picture, WhenAnAutomatonIsWritten_ThenStatesAndEdges) {
  Pictures pictures;
  pictures.automata.push_back({.id = "task", .text = "visit a", .variable = "s"});
  pictures.automata[0].states = {
      {.state = 0, .left = 1},
      {.state = 1, .column = 1, .verdict = AutomatonPicture::Verdict::Done, .left = 0},
      {.state = 2, .column = 1, .row = 1.0, .verdict = AutomatonPicture::Verdict::Failed}};
  pictures.automata[0].edges = {{.from = 0, .to = 1, .letters = {{"a"}, {"a", "b"}}}};
  const std::string text = to_json(pictures);
  for (const char* part :
       {R"("verdict":"done")", R"("verdict":"failed")", R"("left":null)", R"("letters":[["a"],["a","b"]])"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

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

TEST(Picture, WhenACellOfArmsIsWritten_ThenInMicrometresAndRowsOfRotations) {
  Pictures pictures;
  pictures.arms.push_back(small_cell());
  const std::string text = to_json(pictures);
  for (const char* part :
       {R"("kind":"arms")", R"("place":[0.123457,0.0,0.0])", R"("motion":"turns")", R"("axis":[0.0,0.0,1.0])",
        R"({"kind":"ball","place":[0.0,0.0,0.0],"radius_m":0.05})", R"("ways":[[[1.0,2.0,3.0,0.5]]])",
        R"("waits":[{"at":0.25,"other":1,"progress":2.0}])",
        R"("place":[0.0,0.0,0.0,0.0,-1.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0])"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

TEST(Picture, WhenWaysOfArmsAreTooLong_ThenTheyAreLeftOutAndThatIsSaid) {
  Pictures pictures;
  pictures.arms.push_back(small_cell());
  pictures.arms[0].arms[0].way.assign(60'000, {{1.23456, 1.23456, 1.23456}, 0.5});
  const std::string text = to_json(pictures);
  EXPECT_LT(text.size(), 3'000u);
  EXPECT_NE(text.find(R"("left_out":["ways"])"), std::string::npos) << text;
  EXPECT_NE(text.find(R"("tool":1)"), std::string::npos) << "all else is there";
}

TEST(Picture, WhenAFloorIsTooLarge_ThenWhatIsLeftOutIsSaid) {
  Pictures pictures;
  pictures.floors.push_back({.id = "hall", .border = square(0.0)});
  pictures.floors[0].corners.assign(60'000, {123.456, 123.456});
  const std::string text = to_json(pictures);
  EXPECT_LT(text.size(), 1'000u);
  EXPECT_NE(text.find(R"("left_out":["regions"])"), std::string::npos) << text;
  pictures.floors[0].border.assign(100'000, {123.456, 123.456});
  EXPECT_LE(to_json(pictures).size(), dds::kMaxPicturesBytes) << "even where nothing is left to be left out";
}

}  // namespace
}  // namespace stepwright::run

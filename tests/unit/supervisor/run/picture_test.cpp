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

TEST(Picture, WhenAMissionDrawsOfItsOwnKind_ThenItStandsBesideTheOthers) {
  OwnPicture crane{R"({"kind":"crane","id":"crane","ropes":[1,2],"left_out":[]})", {"ropes"}};
  const std::string both = to_json({.floors = {{.id = "hall"}}, .own = {crane}});
  EXPECT_NE(both.find(R"({"id":"crane","kind":"crane","left_out":[],"ropes":[1,2]})"), std::string::npos)
      << both;
  EXPECT_NE(both.find(R"("id":"hall")"), std::string::npos) << both;
  crane.json = R"({"kind":"crane","id":"crane","hooks":2,"left_out":[],"ropes":")" +
               std::string(dds::kMaxPicturesBytes, 'x') + R"("})";
  EXPECT_EQ(to_json({.own = {crane}}),
            R"({"pictures":[{"hooks":2,"id":"crane","kind":"crane","left_out":["ropes"]}]})");
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

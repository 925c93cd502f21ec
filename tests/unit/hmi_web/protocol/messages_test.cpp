#include "hmi_web/protocol/messages.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stepwright::protocol {
namespace {

using nlohmann::json;

TEST(HelloMessage, WhenThePlantIsDescribed_ThenEveryElementIsInIt) {
  Synoptic synoptic;
  synoptic.points = {{"a1.level", "a1", "%", true}};
  synoptic.places = {{"a1", "Distributor a1", -1, "fc2"}};
  synoptic.tanks = {{"a1", "Distributor a1", TankSide::Below, "a1", "a1.level", "", 20, 100}};
  synoptic.pumps = {{"B3", "customer pump", "B3.on", ""}};
  synoptic.pipes = {{"a1", "f1", "B3", ""}};
  synoptic.belts = {{"r", "reader", "belt_r", 0, -0.25, 0.8, 0.25, 1, 0}};
  synoptic.beams = {{"eye_r", "eye_r", 0.6, -0.1, 0.6, 0.1}};
  synoptic.pushers = {{"1", "1", "push_1", "1.travel", 1.3, 0.3, 0.5, 0.04, 0, -1, 0.7}};
  synoptic.boxes = {{"box 1", "1", 0.3, 0.25, "s", "x", "y", "a"}};

  const json message = json::parse(hello_message({"bench", "1.2.3"}, synoptic, "e1"));

  EXPECT_EQ(message["type"], "hello");
  EXPECT_EQ(message["protocol"], kProtocolVersion);
  EXPECT_EQ(message["epoch"], "e1");
  EXPECT_EQ(message["cell"], "bench");
  EXPECT_EQ(message["synoptic"]["places"][0]["position"], -1);
  EXPECT_EQ(message["synoptic"]["tanks"][0]["side"], "below");
  EXPECT_EQ(message["synoptic"]["tanks"][0]["high_percent"], 100);
  EXPECT_EQ(message["synoptic"]["pumps"][0]["running"], "B3.on");
  EXPECT_EQ(message["synoptic"]["pipes"][0]["pump"], "B3");
  EXPECT_TRUE(message["synoptic"]["vehicles"].empty());
  EXPECT_EQ(message["synoptic"]["belts"][0]["low"], json::parse("[0, -0.25]"));
  EXPECT_EQ(message["synoptic"]["belts"][0]["running"], "belt_r");
  EXPECT_EQ(message["synoptic"]["beams"][0]["to"], json::parse("[0.6, 0.1]"));
  EXPECT_EQ(message["synoptic"]["pushers"][0]["direction"], json::parse("[0, -1]"));
  EXPECT_EQ(message["synoptic"]["pushers"][0]["stroke"], 0.7);
  EXPECT_EQ(message["synoptic"]["boxes"][0]["size"], json::parse("[0.3, 0.25]"));
  EXPECT_EQ(message["synoptic"]["boxes"][0]["angle"], "a");
}

TEST(HelloMessage, WhenTheCellDescribesTags_ThenWhatItSaysIsInItAndNothingElse) {
  Greeting greeting{"bench", "1.2.3"};
  greeting.tags = {{"Main.level", "l", "level of the buffer", "buffer", 1, std::pair(0.0, 200.5), {}},
                   {"mode", "", "", "", std::nullopt, std::nullopt, {"off", "by hand"}}};

  const json tags = json::parse(hello_message(greeting, {}, "e1"))["tags"];

  EXPECT_EQ(tags, json::parse(R"([{"name": "Main.level", "unit": "l", "description": "level of the buffer",
      "group": "buffer", "decimals": 1, "normal": [0.0, 200.5]}, {"name": "mode", "values": ["off", "by hand"]}])"));
  EXPECT_EQ(json::parse(hello_message({"bench", "1.2.3"}, {}, "e1"))["tags"], json::array());
}

TEST(ProgramMessage, WhenATagIsAnEnumeration_ThenTheNamesOfItsValuesAreSentOnce) {
  Program program;
  program.tags = {{"a", "INT", "", "", 0}, {"b", "INT", "", "", 0}, {"n", "INT", "", "pieces"}};
  program.enumerations = {{{-1, "Fault"}, {0, "Off"}, {7, "Auto"}}};

  const json message = json::parse(program_message(program));

  EXPECT_EQ(message["enumerations"], json::parse(R"([{"-1": "Fault", "0": "Off", "7": "Auto"}])"));
  EXPECT_EQ(message["tags"][1]["enumeration"], 0);
  EXPECT_FALSE(message["tags"][2].contains("enumeration"));
  EXPECT_EQ(message["tags"][2]["comment"], "pieces");
  EXPECT_FALSE(message["tags"][0].contains("comment"));
}

TEST(ProgramMessage, WhenADeclarationSaysMore_ThenTheTagHasItWithoutAName) {
  Program program;
  program.tags = {{"level", "REAL", ""}, {"n", "INT", ""}};
  program.tags[0].note.unit = "l";
  program.tags[0].note.normal = {0.0, 200.0};

  const json message = json::parse(program_message(program));

  EXPECT_EQ(message["tags"][0]["note"], json::parse(R"({"unit": "l", "normal": [0.0, 200.0]})"));
  EXPECT_FALSE(message["tags"][1].contains("note"));
}

TEST(HelloMessage, WhenThePlantIsAFloor_ThenItsMapAndVehiclesAreInIt) {
  Synoptic synoptic;
  synoptic.floor.maps = {{-1, 2.5, 0.0125, 10, 5, {{3, 1, 2, 2, -2}}}};
  Forklift v1;
  v1.id = "v1";
  v1.front_m = 1.6;
  v1.wheelbase_m = 1.9;
  v1.heading_point = "v1.heading";
  v1.true_x_point = "v1.true_x";
  synoptic.floor.forklifts = {v1};
  synoptic.floor.pallets = {{"pallet p1", "p1", 1.2, 0.8, "s", "x", "y", "a"}};
  synoptic.floor.blockages = {{"block_1", "block_1", 20, 12, 0.5, 2, 1, "there"}};
  synoptic.floor.estop_ok_point = "estop_ok";

  const json floor = json::parse(hello_message({"fleet", "1.2.3"}, synoptic, "e1"))["synoptic"]["floor"];

  EXPECT_EQ(
      floor["maps"][0],
      json::parse(R"({"low": [-1, 2.5], "cell": 0.0125, "size": [10, 5], "outlines": [[3, 1, 2, 2, -2]]})"));
  EXPECT_EQ(floor["forklifts"][0]["front"], 1.6);
  EXPECT_EQ(floor["forklifts"][0]["wheelbase"], 1.9);
  EXPECT_EQ(floor["forklifts"][0]["heading"], "v1.heading");
  EXPECT_EQ(floor["forklifts"][0]["true_x"], "v1.true_x");
  EXPECT_EQ(floor["forklifts"][0]["bumper"], "");
  EXPECT_EQ(floor["pallets"][0]["size"], json::parse("[1.2, 0.8]"));
  EXPECT_EQ(floor["blockages"][0]["at"], json::parse("[20, 12]"));
  EXPECT_EQ(floor["blockages"][0]["there"], "there");
  EXPECT_EQ(floor["estop_ok"], "estop_ok");
}

TEST(ProgramMessage, WhenAChartBranches_ThenTransitionsNameAllTheirSteps) {
  Program program;
  program.digest = "ab12";
  program.steps = {{"START", "", true}, {"S01_LOAD", "(load v1 f1 level8)", false}, {"W", "", false}};
  program.transitions = {{"T0", {0}, {1, 2}, "fc1"}};
  program.tags = {{"fc1", "BOOL", "%IX0.0"}};
  program.charts = {{"PLAN", 3, 1}};

  const json message = json::parse(program_message(program, {{0}, {}}));

  EXPECT_EQ(message["type"], "program");
  EXPECT_EQ(message["steps"][0]["initial"], true);
  EXPECT_EQ(message["steps"][1]["comment"], "(load v1 f1 level8)");
  EXPECT_EQ(message["transitions"][0]["to"], json({1, 2}));
  EXPECT_EQ(message["tags"][0]["address"], "%IX0.0");
  EXPECT_EQ(message["charts"], json::parse(R"([{"name": "PLAN", "steps": 3, "transitions": 1}])"));
  EXPECT_EQ(message["points"], json::parse("[[0], []]"));
}

TEST(TrendMessage, WhenRowsAreGiven_ThenTimeComesFirst) {
  const std::vector<TrendRow> rows = {{1.5, {20.0, std::nullopt}}, {1.6, {20.5, 3.0}}};

  const json message = json::parse(trend_message(rows, {3, 12, true}));

  EXPECT_EQ(message["run"], 3);
  EXPECT_EQ(message["first"], 12);
  EXPECT_EQ(message["restart"], true);
  EXPECT_EQ(message["rows"], json({{1.5, 20, nullptr}, {1.6, 20.5, 3}}));
}

TEST(Revision, WhenAnObjectGetsOne_ThenItIsAMemberOfIt) {
  EXPECT_EQ(json::parse(with_revision(R"({"a":1})", 7)), json({{"a", 1}, {"revision", 7}}));
  EXPECT_EQ(json::parse(with_revision("{}", 7)), json({{"revision", 7}}));
}

}  // namespace
}  // namespace stepwright::protocol

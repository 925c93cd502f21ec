#include "supervisor/fleet/mission/problem_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "supervisor/fleet/schedule/json_place.h"
#include "tests/support/fleet/floor_maps.h"

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

const std::filesystem::path kExamples = std::filesystem::path(STEPWRIGHT_SOURCE_DIR) / "tests/cells/fleet";

// On the warehouse's map, 80 x 60 m.
const std::string kSound = R"({
 "map": "warehouse.yaml",
 "models": [
  {"name": "forklift", "min_turning_radius_m": 3.5},
  {"name": "small", "width_m": 1.0}],
 "vehicles": [
  {"name": "v1", "start": {"x_m": 3, "y_m": 8, "heading_deg": 90}, "capacity": 2, "max_mps": 2,
   "route": [{"pick_up": "g1", "amount": 2}, {"set_down": "g1", "amount": 2}]},
  {"name": "v2", "model": "small", "start": {"x_m": 3, "y_m": 28, "heading_deg": 90}, "available_ms": 5000},
  {"name": "v3", "path": [[75, 10, 90], [75, 30, 90]]},
  {"name": "v4", "polygons": [{"corners_m": [[70, 50], [74, 50], [74, 54]], "stay_ms": [0, null]}]}],
 "locations": [
  {"name": "dock", "service_ms": 1000, "pose": {"x_m": 14, "y_m": 3, "heading_deg": 0}},
  {"name": "rack", "pose": {"x_m": 14, "y_m": 22, "heading_deg": 0}}],
 "goals": [
  {"name": "g1", "amount": 2, "from": "dock", "to": "rack", "vehicle": "v1", "deadline_ms": 90000},
  {"name": "g2", "amount": 5, "from": "dock", "to": "rack", "after": ["g1"], "due_ms": 70000}],
 "tasks": [
  {"vehicle": "v2", "to": {"x_m": 3, "y_m": 40, "heading_deg": 90}}],
 "constraints": [
  {"name": "c1", "from": {"goal": "g1", "at": "end"}, "to": {"task": "task 1", "at": "start"}, "distance_ms": [-5, null]}]
})";

result::Result<MissionProblem> read(const std::string& text) {
  return read_mission_problem(text, kExamples / "p.json");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

std::string complaint(const std::string& from, const std::string& to) {
  const auto problem = read(replaced(kSound, from, to));
  return problem ? "nothing" : to_string(problem.error());
}

TEST(ProblemReader, File_WhenSound_ThenItHoldsWhatIsWritten) {
  const auto problem = read(kSound);
  ASSERT_TRUE(problem.has_value()) << to_string(problem.error());
  ASSERT_EQ(problem->vehicles.size(), 4u);
  EXPECT_EQ(problem->vehicles[0].vehicle_class, 0u);
  EXPECT_EQ(problem->vehicles[0].speed.max_mps, 2.0);
  EXPECT_EQ(problem->vehicles[0].route.size(), 2u);
  EXPECT_EQ(problem->classes[problem->vehicles[1].vehicle_class].model.width_m, 1.0);
  EXPECT_EQ(problem->vehicles[1].available, 5s);
  EXPECT_NEAR(problem->vehicles[2].path.value().back().arc_m, 20.0, 1e-9);
  EXPECT_TRUE(problem->vehicles[3].envelope.has_value());
  EXPECT_EQ(problem->locations[0].service, 1s);
  EXPECT_EQ(problem->goals[0].vehicle, 0u);
  EXPECT_EQ(problem->goals[1].after, std::vector<std::size_t>{0});
  EXPECT_EQ(problem->goals[1].due, 70s);
  EXPECT_EQ(problem->locations[problem->tasks[0].location].pose.y_m, 40.0);
  ASSERT_EQ(problem->constraints.size(), 2u);
  EXPECT_EQ(problem->constraints[0].name, "deadline of g1");
  EXPECT_EQ(problem->constraints[1].from.moment, Moment::GoalEnd);
  EXPECT_EQ(problem->constraints[1].distance, (Bounds{-5ms, 100'000s}));
  EXPECT_EQ(place_of(*problem, "constraints[0].from").line, 21u);
}

TEST(ProblemReader, Examples_WhenRead_ThenTheMineIsTheDrawnOne) {
  for (const char* name : {"mine.json", "warehouse.json"}) {
    std::ostringstream text;
    text << std::ifstream(kExamples / name).rdbuf();
    const auto problem = read_mission_problem(text.str(), kExamples / name);
    ASSERT_TRUE(problem.has_value()) << to_string(problem.error());
    if (std::string(name) != "mine.json") continue;
    const OccupancyGrid drawn = support::draw_mine(1).grid;
    ASSERT_EQ(problem->map.frame(), drawn.frame());
    int different = 0;
    for (int row = 0; row < drawn.frame().rows; ++row) {
      for (int column = 0; column < drawn.frame().columns; ++column) {
        different += problem->map.blocked({column, row}) != drawn.blocked({column, row}) ? 1 : 0;
      }
    }
    EXPECT_EQ(different, 0);
  }
}

TEST(ProblemReader, Names_WhenUnknownOrTwice_ThenToldWithWhatWasMeant) {
  EXPECT_THAT(
      complaint("\"from\": \"dock\"", "\"from\": \"duck\""),
      HasSubstr(
          "p.json:16:31: F0704: goals[0].from: no location is called 'duck'\n  hint: did you mean 'dock'?"));
  EXPECT_THAT(complaint("\"model\": \"small\"", "\"model\": \"smal\""), HasSubstr("did you mean 'small'?"));
  EXPECT_THAT(complaint("\"vehicle\": \"v2\"", "\"vehicle\": \"x9\""),
              HasSubstr("tasks[0].vehicle: no vehicle is called 'x9'"));
  EXPECT_THAT(complaint("\"name\": \"v2\"", "\"name\": \"v1\""),
              HasSubstr("F0705: vehicles[1].name: another vehicle is called 'v1'"));
  EXPECT_THAT(complaint("\"capacity\"", "\"capasity\""),
              HasSubstr("vehicles[0].capasity: is not known here\n  hint: did you mean 'capacity'?"));
  EXPECT_THAT(complaint("\"available_ms\": 5000", "\"available_ms\": 5, \"available_ms\": 6"),
              HasSubstr("'available_ms' is there twice"));
}

TEST(ProblemReader, Values_WhenWrong_ThenToldWithTheirPlace) {
  EXPECT_THAT(complaint("[{\"pick_up\"", "[,{\"pick_up\""), HasSubstr("p.json:8:14: F0701"));
  EXPECT_THAT(complaint("\"x_m\": 3, \"y_m\": 8", "\"x_m\": \"3\", \"y_m\": 8"),
              HasSubstr("p.json:7:28: F0702: vehicles[0].start.x_m: is no number"));
  EXPECT_THAT(complaint("\"capacity\": 2", "\"capacity\": -1"), HasSubstr("F0703: vehicles[0].capacity"));
  EXPECT_THAT(complaint("\"capacity\": 2", "\"capacity\": 1.5"), HasSubstr("is no whole number"));
  EXPECT_THAT(complaint("\"max_mps\": 2", "\"max_mps\": 2, \"min_mps\": 3"),
              HasSubstr("F0502: vehicles[0].min_mps is 3 m/s"));
  EXPECT_THAT(complaint("\"min_turning_radius_m\": 3.5", "\"wheelbase_m\": 9"), HasSubstr("F0202"));
  EXPECT_THAT(complaint("\"map\": \"warehouse.yaml\"", "\"map\": \"nowhere.yaml\""), HasSubstr("F0101"));
  EXPECT_THAT(complaint("\"map\": \"warehouse.yaml\",", ""), HasSubstr("F0702: lacks 'map'"));
  EXPECT_THAT(complaint("[-5, null]", "[5, 1]"), HasSubstr("F0706: constraints[0].distance_ms"));
  EXPECT_THAT(complaint("\"at\": \"start\"", "\"at\": \"begin\""), HasSubstr("is neither 'start' nor 'end'"));
  EXPECT_THAT(complaint("[75, 30, 90]", "[70, 30, 90]"), HasSubstr("F0709: vehicles[2].path[1]"));
  EXPECT_THAT(complaint("[74, 50], [74, 54]", "[74, 50]"),
              HasSubstr("F0603: vehicles[3].polygons[0].corners_m: has not 3"));
}

TEST(ProblemReader, Parts_WhenTheyContradictEachOther_ThenTold) {
  EXPECT_THAT(complaint("\"to\": \"rack\", \"vehicle\"", "\"to\": \"dock\", \"vehicle\""),
              HasSubstr("begins and ends at the same location"));
  EXPECT_THAT(complaint("{\"vehicle\": \"v2\", \"to\"", "{\"vehicle\": \"v3\", \"to\""),
              HasSubstr("'v3' drives the path that is given for it"));
  EXPECT_THAT(complaint("\"path\": [[75, 10, 90]", "\"start\": 1, \"path\": [[75, 10, 90]"),
              HasSubstr("more than one of"));
  EXPECT_THAT(complaint("{\"set_down\": \"g1\", \"amount\": 2}", "{\"set_down\": \"g1\", \"amount\": 1}"),
              HasSubstr("1 of 'g1' are set down before"));
  EXPECT_THAT(complaint("{\"pick_up\": \"g1\", \"amount\": 2}", "{\"pick_up\": \"g1\", \"amount\": 3}"),
              HasSubstr("3 loads are more than the 2"));
  EXPECT_THAT(complaint("\"after\": [\"g1\"]", "\"after\": [\"g2\"]"),
              HasSubstr("does not come after itself"));
  EXPECT_THAT(
      complaint("\"amount\": 5", "\"amount\": 5, \"divisible\": false"),
      HasSubstr("F0708: goals[1]: 'g2' is not divisible, and 5 loads are more than any vehicle carries (2)"));
}

TEST(ProblemReader, Places_WhenNoVehicleCanStandThere_ThenTheCellIsNamed) {
  EXPECT_THAT(complaint("\"x_m\": 14, \"y_m\": 22", "\"x_m\": 14, \"y_m\": 24"),
              HasSubstr("F0707: locations[1]: no vehicle can stand at 'rack': the cell at ("));
  EXPECT_THAT(complaint("\"x_m\": 3, \"y_m\": 40", "\"x_m\": 300, \"y_m\": 40"),
              HasSubstr("(300.00 m, 40.00 m) is off the map\n  hint: the map reaches from"));
  EXPECT_THAT(complaint("\"x_m\": 3, \"y_m\": 8", "\"x_m\": 3, \"y_m\": 1"),
              HasSubstr("'v1' cannot stand there: the vehicle would stand over the border"));
  EXPECT_THAT(complaint("\"x_m\": 3, \"y_m\": 28", "\"x_m\": 4, \"y_m\": 9"),
              HasSubstr("'v2' begins where 'v1' stands"));
}

TEST(ProblemReader, Faults_WhenThereAreMany_ThenAllAreTold) {
  std::string text = replaced(kSound, "\"from\": \"dock\"", "\"from\": \"duck\"");
  text = replaced(text, "\"capacity\": 2", "\"capacity\": -1");
  text = replaced(text, "\"vehicle\": \"v2\"", "\"vehicle\": \"x9\"");
  text = replaced(text, "\"warehouse.yaml\"", "\"nowhere.yaml\"");
  const auto problem = read(text);
  ASSERT_FALSE(problem.has_value());
  EXPECT_GE(problem.error().size(), 4u) << to_string(problem.error());
}

TEST(ProblemReader, Kind_WhenEnvelopesAlone_ThenForTheScheduler) {
  EXPECT_TRUE(is_scheduling_problem(R"({"vehicles": [{"name": "v", "polygons": []}]})"));
  EXPECT_FALSE(is_scheduling_problem(kSound));
  EXPECT_FALSE(is_scheduling_problem("[1, 2"));
}

TEST(JsonPlace, Key_WhenItIsThere_ThenItsLineAndColumn) {
  const std::string text = "{\n \"a\": [1, {\"b\\\"\": \"]\",\n  \"c\": [[], 7]}],\n \"d\": null}";
  EXPECT_EQ(place_of_key(text, "a[1].c[1]", "").line, 3u);
  EXPECT_EQ(place_of_key(text, "a[1].c[1]", "").column, 13u);
  EXPECT_EQ(place_of_key(text, "d", "").line, 4u);
  EXPECT_EQ(place_of_key(text, "a[9].x", "").line, 2u);  // as far as it is there
  EXPECT_FALSE(double_member(text, "").has_value());
  EXPECT_EQ(double_member("{\"a\": {\"b\": 1},\n \"a\": [\"a\", \"a\"]}", "").value().where.line, 2u);
}

}  // namespace
}  // namespace stepwright::fleet

#include "supervisor/fleet/schedule/problem_file.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <string>

#include "supervisor/fleet/schedule/schedule.h"
#include "tests/unit/supervisor/fleet/schedule/random_problem.h"

namespace stepwright::fleet {
namespace {

using namespace std::chrono_literals;

const std::string kSound = R"({
"vehicles": [
  {"name": "v1", "polygons": [
    {"corners_m": [[0, 0], [5, 0], [5, 2], [0, 2]], "stay_ms": [2000, 60000], "overlap_ms": [300, 9000]},
    {"corners_m": [[4, 0], [9, 0], [9, 2], [4, 2]], "stay_ms": [2000, null]}]},
  {"name": "v2", "polygons": [
    {"corners_m": [[20, 0], [25, 0], [25, 2]], "stay_ms": [0, 0]}]}],
"constraints": [
  {"name": "in time", "from": {"vehicle": "v2", "polygon": 0, "side": "entry"},
   "to": {"vehicle": "v1", "polygon": 1, "side": "exit"}, "distance_ms": [-50, 30000]},
  {"name": "start", "to": {"vehicle": "v1", "polygon": 0, "side": "entry"}, "distance_ms": [0, null]}]
})";

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = kSound;
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

void expect_rejected(const std::string& text, const std::string& code, const std::string& words) {
  const auto problem = read_problem(text, "p.json");
  ASSERT_FALSE(problem.has_value()) << code << " " << words;
  EXPECT_EQ(problem.error().front().code, code);
  EXPECT_NE(to_string(problem.error()).find(words), std::string::npos) << to_string(problem.error());
}

TEST(ProblemFile, Read_WhenItIsSound_ThenItHoldsWhatIsWritten) {
  const auto problem = read_problem(kSound, "p.json");
  ASSERT_TRUE(problem.has_value()) << to_string(problem.error());
  ASSERT_EQ(problem->envelopes.size(), 2u);
  const TrajectoryEnvelope& v1 = problem->envelopes[0];
  EXPECT_EQ(v1.vehicle, "v1");
  ASSERT_EQ(v1.polygons.size(), 2u);
  EXPECT_EQ(v1.polygons[0].stay, (Bounds{2s, 60s}));
  EXPECT_EQ(v1.polygons[0].overlap, (Bounds{300ms, 9s}));
  EXPECT_EQ(v1.polygons[1].stay.most, 100'000s);
  EXPECT_DOUBLE_EQ(v1.polygons[0].area.area_m2(), 10.0);
  ASSERT_EQ(problem->constraints.size(), 2u);
  EXPECT_EQ(problem->constraints[0].from, (TimepointRef{{1, 0}, Side::Entry}));
  EXPECT_EQ(problem->constraints[0].to, (TimepointRef{{0, 1}, Side::Exit}));
  EXPECT_EQ(problem->constraints[0].distance, (Bounds{-50ms, 30s}));
  EXPECT_FALSE(problem->constraints[1].from.has_value());
}

TEST(ProblemFile, Read_WhenAPolygonIsLeftIntoOneFartherOn_ThenThatIsReadAndWritten) {
  const auto problem = read_problem(replaced("[300, 9000]", "[300, 9000], \"left_into\": 2"), "p.json");
  ASSERT_TRUE(problem.has_value()) << to_string(problem.error());
  EXPECT_EQ(problem->envelopes[0].polygons[0].left_into, 2u);
  EXPECT_EQ(problem->envelopes[0].polygons[1].left_into, 1u);
  const auto again = read_problem(write_problem(*problem), "p.json");
  ASSERT_TRUE(again.has_value()) << to_string(again.error());
  EXPECT_EQ(again->envelopes[0].polygons[0].left_into, 2u);
  expect_rejected(replaced("[300, 9000]", "[300, 9000], \"left_into\": 0"), "F0602",
                  "left_into: is no whole number");
  expect_rejected(replaced("[2000, null]", "[2000, null], \"left_into\": 1"), "F0604",
                  "left_into: belongs to no next polygon");
}

TEST(ProblemFile, Read_WhenSomethingIsWrong_ThenItSaysWhatAndWhere) {
  expect_rejected("{\n \"vehicles\": [,]}", "F0601", "p.json:2:15");
  expect_rejected("", "F0601", "p.json:1:1");
  expect_rejected(replaced("[5, 2], [0, 2]", "[5, 1e999], [0, 2]"), "F0601", "too large");
  expect_rejected("[]", "F0602", "is no object");
  expect_rejected("{}", "F0602", "lacks 'vehicles'");
  expect_rejected(replaced("\"constraints\"", "\"constraint\""), "F0602", "constraint: is not known here");
  expect_rejected(replaced("\"name\": \"v1\"", "\"name\": 7"), "F0602", "vehicles[0].name");
  expect_rejected(replaced("\"side\": \"exit\"", "\"side\": \"end\""), "F0602", "constraints[0].to.side");
  expect_rejected(replaced("[5, 2], [0, 2]", "[1, 1], [0, 2]"), "F0603",
                  "vehicles[0].polygons[0].corners_m: is not");
  expect_rejected(replaced("[5, 0], [5, 2], [0, 2]", "[1, 1], [2, 2], [3, 3]"), "F0603", "has no area");
  expect_rejected(replaced("[[20, 0], [25, 0], [25, 2]]", "[[20, 0], [25, 0]]"), "F0603", "3 to 64");
  expect_rejected(replaced("[20, 0]", "[20, 2e6]"), "F0603", "corners_m[0][1]");
  expect_rejected(replaced("[20, 0]", "[null, 0]"), "F0603", "corners_m[0][0]");
  expect_rejected(replaced("[[4, 0], [9, 0], [9, 2], [4, 2]]", "[[5, 0], [9, 0], [9, 2], [5, 2]]"), "F0603",
                  "vehicles[0].polygons[1]: does not overlap");
  expect_rejected(replaced("[2000, 60000]", "[2000, 1000]"), "F0604", "most below its least");
  expect_rejected(replaced("[2000, 60000]", "[-1, 1000]"), "F0604", "stay_ms[0]");
  expect_rejected(replaced("[2000, 60000]", "[2000, 1.5]"), "F0604", "stay_ms[1]");
  expect_rejected(replaced("[2000, 60000]", "[2000, 18446744073709551615]"), "F0604", "stay_ms[1]");
  expect_rejected(replaced("[2000, 60000]", "[0, 200]"), "F0604", "longer than the stay");
  expect_rejected(replaced("[2000, null]", "[0, 200]"), "F0604", "shorter than the overlap");
  expect_rejected(replaced("\"stay_ms\": [0, 0]", "\"stay_ms\": [0, 0], \"overlap_ms\": [0, 0]"), "F0604",
                  "no next polygon");
  expect_rejected(replaced("\"v2\", \"polygons\"", "\"v1\", \"polygons\""), "F0605", "vehicles[1].name");
  expect_rejected(replaced("{\"vehicle\": \"v2\"", "{\"vehicle\": \"v3\""), "F0605",
                  "no vehicle is called 'v3'");
  expect_rejected(replaced("\"polygon\": 1", "\"polygon\": 2"), "F0605", "polygons 0 to 1");
}

TEST(ProblemFile, Write_WhenItIsReadAgain_ThenItIsTheSameProblem) {
  std::mt19937 random(51);
  int same = 0;
  for (int round = 0; round < 200; ++round) {
    const Problem problem = random_problem(4, 6, random);
    const std::string text = write_problem({problem.envelopes, problem.constraints});
    const auto read = read_problem(text, "p.json");
    if (!read) {
      // Random envelopes may contradict themselves in what a file must not.
      EXPECT_EQ(read.error().front().code.substr(0, 4), "F060") << to_string(read.error());
      continue;
    }
    ++same;
    EXPECT_EQ(write_problem(*read), text);
    EXPECT_EQ(schedule(read->envelopes, read->constraints, {}).earliest,
              schedule(problem.envelopes, problem.constraints, {}).earliest);
  }
  EXPECT_GT(same, 20);
}

TEST(ProblemFile, Read_WhenTextIsBrokenAtRandom_ThenItIsRejectedOrSound) {
  std::mt19937 random(52);
  const std::string characters = "{}[]\",:-+.0123456789eEnul \n\t\xff\\x";
  int sound = 0;
  for (int round = 0; round < 8000; ++round) {
    std::string text = kSound;
    for (std::size_t edits = 1 + random() % 4; edits > 0; --edits) {
      const std::size_t place = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[place] = characters[random() % characters.size()];
          break;
        case 1:
          text.erase(place, random() % 12);
          break;
        case 2:
          text.insert(place, 1, characters[random() % characters.size()]);
          break;
        default:
          text.insert(place, text.substr(random() % text.size(), random() % 40));
          break;
      }
    }
    const auto problem = read_problem(text, "p.json");
    if (!problem) {
      EXPECT_FALSE(problem.error().front().code.empty());
      continue;
    }
    ++sound;
    const Schedule made = schedule(problem->envelopes, problem->constraints, {.time = 1s});
    EXPECT_TRUE(made.verdict == Verdict::Scheduled || made.verdict == Verdict::Infeasible);
  }
  EXPECT_GT(sound, 100);
}

TEST(ProblemFile, Read_WhenListsAreNestedDeeply_ThenItIsRejected) {
  const std::string deep = "{\"vehicles\": " + std::string(200'000, '[') + std::string(200'000, ']') + "}";
  expect_rejected(deep, "F0602", "vehicles[0]");
}

}  // namespace
}  // namespace stepwright::fleet

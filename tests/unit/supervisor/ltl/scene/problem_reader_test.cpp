#include "supervisor/ltl/scene/problem_reader.h"

#include <gtest/gtest.h>

#include <random>

namespace stepwright::ltl {
namespace {

const std::filesystem::path kFolder = std::filesystem::path(STEPWRIGHT_SOURCE_DIR) / "tests/cells";
constexpr const char* kStart = R"("start": {"x_m": 0, "y_m": -21, "heading_rad": 1.5})";

result::Result<Problem> read(const std::string& members) {
  return read_planning_problem("{" + members + "}", kFolder / "problem.json");
}

std::vector<std::string> errors_of(const std::string& members) {
  const auto problem = read(members);
  std::vector<std::string> found;
  if (problem) return found;
  for (const auto& each : problem.error()) {
    EXPECT_FALSE(each.where.file.empty()) << each.message;
    found.push_back(each.code + " " + each.message);
  }
  return found;
}

std::string with(const std::string& train) {
  return R"("scene": "ltl/walls.geojson", "task": "visit p1", "train": )" + train + ", " + kStart;
}

TEST(ProblemReader, WhenAProblemIsSound_ThenItHasSceneTrainStartAndTask) {
  const auto problem = read(with(R"({"trailers": 5, "reading": "printed", "hitch_m": 0.8})"));
  ASSERT_TRUE(problem) << to_string(problem.error());
  EXPECT_EQ(problem->floor.obstacles.size(), 16u);
  EXPECT_EQ(problem->places().front(), "p1");
  EXPECT_EQ(problem->train.trailers, 5u);
  EXPECT_EQ(problem->train.reading, HitchReading::Printed);
  EXPECT_DOUBLE_EQ(problem->train.hitch_m, 0.8);
  EXPECT_DOUBLE_EQ(problem->start.y_m, -21.0);
  EXPECT_EQ(problem->task, "visit p1");
}

TEST(ProblemReader, WhenMembersAreWrong_ThenAllOfThemAreToldAtOnce) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(errors_of(R"("speed": 1)"),
            (Texts{"L0402 speed: is not known here", "L0402 scene: is missing", "L0402 start: is missing",
                   "L0402 task: is missing or no text"}));
  EXPECT_EQ(errors_of(R"("scene": 3, "map": [], "start": {"x_m": 1e7, "y_m": "a", "z_m": 0}, "task": "a")"),
            (Texts{"L0402 map: is no file name", "L0402 start.z_m: is not known here",
                   "L0403 start.x_m: is out of range", "L0402 start.y_m: is no number",
                   "L0402 start.heading_rad: is missing"}));
}

TEST(ProblemReader, WhenTheTrainIsWrong_ThenItsFiguresAreNamed) {
  using Texts = std::vector<std::string>;
  EXPECT_EQ(errors_of(with("7")), Texts{"L0402 train: is no object"});
  EXPECT_EQ(errors_of(with(R"({"trailers": 16})")), Texts{"L0403 train.trailers: is out of range"});
  EXPECT_EQ(
      errors_of(with(R"({"trailers": 1.5, "reading": 3})")),
      (Texts{"L0402 train.trailers: is no whole number", "L0402 train.reading: is none of pulled, printed"}));
  EXPECT_EQ(errors_of(with(R"({"hitch_m": 0})")), Texts{"L0301 train: hitch_m must be greater than 0"});
}

TEST(ProblemReader, WhenAMemberIsThereTwice_ThenThatIsSaid) {
  EXPECT_EQ(errors_of(with(R"({"trailers": 5, "trailers": 6})")),
            std::vector<std::string>{"L0405 the member \"trailers\" is there twice"});
}

TEST(ProblemReader, WhenAFileCannotBeRead_ThenThatIsSaid) {
  for (const char* name : {"nowhere.geojson", "ltl", "", ".", "/dev/zero"}) {
    const auto errors = errors_of(R"("scene": ")" + std::string(name) + R"(", "task": "a", )" + kStart);
    ASSERT_EQ(errors.size(), 1u) << name;
    EXPECT_EQ(errors[0].substr(0, 12), "L0401 scene:") << name;
  }
  const auto map = errors_of(R"("map": "nowhere.yaml", "task": "a", )" + std::string(kStart));
  ASSERT_EQ(map.size(), 1u);
  EXPECT_EQ(map[0].substr(0, 5), "F0101");
}

TEST(ProblemReader, WhenTheTextIsRandom_ThenItIsRefused) {
  std::mt19937 dice(4);
  const std::string sound = "{" + with(R"({"trailers": 5})") + "}";
  for (int round = 0; round < 500; ++round) {
    std::string noise(dice() % 200, ' ');
    for (char& each : noise) each = static_cast<char>(dice() % 256);
    EXPECT_FALSE(read_planning_problem(noise, "x.json"));
    EXPECT_FALSE(read_planning_problem(sound.substr(0, dice() % sound.size()), kFolder / "x.json"));
  }
}

}  // namespace
}  // namespace stepwright::ltl

// Scenes and problems of the LTL planner, and thousands of mutations of them, through the readers, the
// triangulation and a search of a few rounds: each is planned for or refused with its reason.
//
// Longer: STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_ltl_scene.

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "supervisor/ltl/planner/plan_train.h"
#include "supervisor/ltl/scene/problem_reader.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/text_mutation.h"
#include "tests/support/temporary_folder.h"

namespace stepwright::fuzz::ltl_scene {
namespace {

using namespace stepwright::ltl;

// A hall of 20 x 20 m with a wall, a rack and a press that overlap nothing.
constexpr const char* kScene = R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"kind": "border", "name": "border"}, "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [20, 0], [20, 20], [0, 20], [0, 0]]]}},
{"type": "Feature", "properties": {"kind": "obstacle", "name": "wall"}, "geometry": {"type": "Polygon", "coordinates": [[[9, 0], [11, 0], [11, 12], [9, 12], [9, 0]]]}},
{"type": "Feature", "properties": {"kind": "proposition", "name": "rack"}, "geometry": {"type": "Polygon", "coordinates": [[[2, 14], [5, 14], [5, 17], [2, 17], [2, 14]]]}},
{"type": "Feature", "properties": {"kind": "proposition", "name": "press"}, "geometry": {"type": "Polygon", "coordinates": [[[15, 3], [18, 3], [18, 6], [15, 6], [15, 3]]]}}
]})";
constexpr const char* kProblem = R"({"scene": "scene.geojson",
"train": {"trailers": 1, "reading": "pulled", "hitch_m": 1.0, "wheelbase_m": 1.0, "length_m": 0.9, "width_m": 0.5, "spacing_m": 1.0, "most_speed_m_s": 2.0, "most_lock_rad": 1.0, "most_acceleration_m_s2": 1.0, "most_lock_rate_rad_s": 1.0},
"start": {"x_m": 4.0, "y_m": 4.0, "heading_rad": 0.5},
"task": "visit rack then visit press"})";

const std::vector<std::string> kPieces = {
    "0",           "-1",         "1e308",  "-1e308", "1e-300", "1e6",           "1000001", "9",
    "11",          "12.0000001", "20",     "0.1",    "null",   "true",          "\"\"",    "[",
    "]",           "{",          "}",      ",",      ":",      "NaN",           "1e999",   "\"rack\"",
    "5",           "[0,0]",      "border", "press",  "visit",  "!rack U press", "\xff",    "\\u0000",
    "\"printed\"", "15"};

void expect_whole(const result::Diagnostics& found, const std::string& input) {
  ASSERT_FALSE(found.empty()) << input;
  for (const result::Diagnostic& each : found)
    EXPECT_TRUE(each.code.size() == 5 && !each.message.empty()) << to_string(found) << "\n" << input;
}

TEST(LtlScene, WhenScenesAndProblemsAreMutated_ThenTheyArePlannedForOrRefusedWithReasons) {
  const support::TemporaryFolder folder;
  const std::string file = (folder / "problem.json").string();
  const std::uint64_t rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", 1'500);
  TextMutation fuzzer(setting("STEPWRIGHT_FUZZ_SEED", 1), kPieces);
  std::size_t read = 0, planned = 0;
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::string scene = round % 3 == 0 ? kScene : fuzzer.mutated(kScene);
    const std::string problem = round % 3 == 1 ? kProblem : fuzzer.mutated(kProblem);
    std::ofstream(folder / "scene.geojson", std::ios::binary) << scene;
    const auto made = read_planning_problem(problem, file);
    if (!made) {
      expect_whole(made.error(), problem + "\n" + scene);
      continue;
    }
    ++read;
    const auto answer =
        plan_train(*made, {.seed = round, .most_s = 600.0, .most_rounds = 3, .most_tries = 1});
    if (!answer) {
      expect_whole(answer.error(), problem + "\n" + scene);
      continue;
    }
    ++planned;
    ASSERT_TRUE(answer->judgement.accepted()) << problem << "\n" << scene;
  }
  std::printf("%zu of %llu were read, %zu planned for\n", read, static_cast<unsigned long long>(rounds),
              planned);
  EXPECT_GT(read, rounds / 40);
  EXPECT_GT(planned, 0u);
}

}  // namespace
}  // namespace stepwright::fuzz::ltl_scene

// `stepwright ltl PROBLEM.json` as a user runs it.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/command_run.h"

namespace stepwright::ltl_test {
namespace {

using testing::HasSubstr;

constexpr const char* kBlocks = STEPWRIGHT_SOURCE_DIR "/tests/cells/ltl/blocks.json";

class PlanCommand : public support::CommandRun {
 protected:
  int run(const std::string& arguments) { return run_program("stepwright", arguments); }

  // The published blocks with another task, and whatever else is changed.
  std::string problem(const std::string& task, const char* more = "\"train\": {\"trailers\": 1}") {
    return write("problem.json", std::string("{\"scene\": \"" STEPWRIGHT_SOURCE_DIR
                                             "/tests/cells/ltl/blocks.geojson\", \"start\": {\"x_m\": -6, "
                                             "\"y_m\": -22, \"heading_rad\": 0}, \"task\": \"") +
                                     task + "\", " + more + "}");
  }
};

// By its times a run may end sooner or later; without time for shorter plans it is the seed's first one.
TEST_F(PlanCommand, WhenItRunsOnOneThreadOrOnTwo_ThenThePlanIsTheSame) {
  const std::string task = problem("visit p1, visit p2");
  nlohmann::json plans[2];
  for (const int threads : {1, 2}) {
    ASSERT_EQ(run("ltl " + task + " --time 600 --shorten 0 --seed 5 --threads " + std::to_string(threads) +
                  " --json " + path("plan.json")),
              0)
        << errors;
    plans[threads - 1] = nlohmann::json::parse(text("plan.json"));
    EXPECT_EQ(plans[threads - 1]["threads"], threads);
    EXPECT_THAT(output, HasSubstr(threads == 1 ? ", 1 thread\n" : ", 2 threads\n"));
  }
  EXPECT_EQ(plans[0]["controls"], plans[1]["controls"]);
  EXPECT_EQ(run("ltl " + task + " --threads 3"), 2);
}

TEST_F(PlanCommand, WhenATaskIsPossible_ThenPlanJsonAndPictureAgree) {
  const std::string generous = " --time 600 --shorten 0 --seed 3 ";
  ASSERT_EQ(run(std::string("ltl ") + kBlocks + generous + "--json " + path("plan.json") + " --svg " +
                path("plan.svg")),
            0)
      << errors;
  EXPECT_THAT(output, HasSubstr("judged: by CVODE"));
  const auto json = nlohmann::json::parse(text("plan.json"));
  EXPECT_EQ(json["solved"], true);
  EXPECT_EQ(json["trailers"], 5);
  std::vector<std::string> visited;
  for (const auto& letter : json["word"])
    for (const auto& place : letter) visited.push_back(place);
  EXPECT_THAT(visited, testing::IsSupersetOf({"p1", "p4", "p6"}));
  EXPECT_LT(std::ranges::find(visited, "p1"), std::ranges::find(visited, "p4"));
  EXPECT_THAT(output, HasSubstr("times the least that a point needs"));
  EXPECT_GT(json["length_m"], json["bound_m"]);
  EXPECT_NEAR(json["length_ratio"].get<double>(),
              json["length_m"].get<double>() / json["bound_m"].get<double>(), 1e-9);
  double sum_s = 0.0;
  for (const auto& each : json["controls"]) sum_s += each["duration_s"].get<double>();
  EXPECT_NEAR(sum_s, json["duration_s"].get<double>(), 1e-6);
  EXPECT_NEAR(json["way"].back()[0].get<double>(), sum_s, 1e-6);
  EXPECT_EQ(json["way"][0].size(), 1u + 5u + 5u);
  EXPECT_THAT(text("plan.svg"), HasSubstr("5 trailers"));
  EXPECT_THAT(text("plan.svg"), HasSubstr("class=\"way\""));
  ASSERT_EQ(run(std::string("ltl plan ") + kBlocks + generous + "--json " + path("again.json")), 0) << errors;
  const auto again = nlohmann::json::parse(text("again.json"));
  EXPECT_EQ(again["controls"], json["controls"]) << "the same seed";
}

TEST_F(PlanCommand, WhenNoPlanCanBe_ThenTheCodeTellsWhy) {
  EXPECT_EQ(run("ltl " + problem("!p1 U p2 & !p2 U p1") + " --json " + path("plan.json")), 3);
  EXPECT_THAT(errors, HasSubstr("L0412"));
  EXPECT_EQ(nlohmann::json::parse(text("plan.json"))["solved"], false);
  write("plan.svg", "<svg>of another run</svg>");
  EXPECT_EQ(run("ltl " + problem("visit p1") + " --time 0 --svg " + path("plan.svg")), 4);
  EXPECT_THAT(errors, HasSubstr("L0413"));
  EXPECT_THAT(errors, HasSubstr("the picture of an earlier run was removed"));
  EXPECT_FALSE(std::filesystem::exists(path("plan.svg")));
}

TEST_F(PlanCommand, WhenAFileIsWrong_ThenItsPlaceIsTold) {
  EXPECT_EQ(run("ltl " + path("nothing.json")), 1);
  EXPECT_EQ(run("ltl " + write("broken.json", "{\n  \"scene\": }")), 1);
  EXPECT_THAT(errors, HasSubstr("broken.json:2:"));
  EXPECT_EQ(run("ltl " + problem("visit p99")), 1);
  EXPECT_THAT(errors, HasSubstr("L0311"));
  EXPECT_EQ(run("ltl " + problem("visit p1", "\"train\": {\"trailers\": 99}")), 1);
  EXPECT_THAT(errors, HasSubstr("train.trailers"));
  EXPECT_EQ(run("ltl " + problem("visit p1") + " --svg /nowhere/plan.svg"), 1);
  EXPECT_EQ(run("ltl " + problem("visit p1") + " --time soon"), 2);
  EXPECT_EQ(run("ltl " + problem("visit p1") + " --time nan"), 2);
  EXPECT_EQ(run("ltl " + problem("visit p1") + " --seed -1"), 2);
  EXPECT_EQ(run("ltl " + problem("visit p1") + " --json ''"), 2);
  EXPECT_EQ(run("ltl " + problem("visit p1") + " --svg ''"), 2);
  EXPECT_EQ(run("ltl " + path(".")), 1);
  EXPECT_EQ(run("ltl " + problem("visit p1") + " --json " + path("same") + " --svg " + path("./same")), 2);
  EXPECT_THAT(errors, HasSubstr("one file for two things"));
  const std::string kept = problem("visit p1");
  EXPECT_EQ(run("ltl " + kept + " --json " + kept), 2);
  EXPECT_THAT(text("problem.json"), HasSubstr("visit p1"));
  EXPECT_EQ(run("ltl " + write("far.json", "{\n\"start\": {\"x_m\": 1e999}}")), 1);
  EXPECT_THAT(errors, HasSubstr("far.json:2:18: L0403"));
}

}  // namespace
}  // namespace stepwright::ltl_test

// What an operator's page asks of a task plan: each word, and what has to go with it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "supervisor/executive/executive.h"
#include "tests/support/controller/simulated_controller.h"
#include "tests/unit/supervisor/executive/bench_fixture.h"
#include "tests/unit/supervisor/run/asked.h"

namespace stepwright::executive {
namespace {

class ExecutiveRequests : public testing::Test {
 protected:
  // The code with which it is refused; empty: it is not.
  std::string code(const std::string& text) { return run::refusal(executive_, text); }

  support::SimulatedController controller_{assemblies::BenchParameters{}};
  Executive executive_{bench_planning(), controller_, ExecutiveOptions(), {}};
};

TEST_F(ExecutiveRequests, WhenTheyCanBeMeant_ThenTheyAreTaken) {
  EXPECT_EQ(code(R"_({"request": "change", "fluent": "(demand c1)", "value": 8.5})_"), "");
  EXPECT_EQ(code(R"_({"request": "goal", "goal": "(= (level a1) 4)"})_"), "");
  EXPECT_EQ(code(R"_({"request": "hold"})_"), "");
  EXPECT_EQ(code(R"_({"request": "resume"})_"), "");
  EXPECT_EQ(code(R"_({"request": "abort"})_"), "");
}

TEST_F(ExecutiveRequests, WhenTheyCannotBeMeantOrNotNow_ThenTheCodeTells) {
  EXPECT_EQ(code(R"_({"request": "change", "fluent": "(demand c9)", "value": 8})_"), "X0003");
  EXPECT_EQ(code(R"_({"request": "goal", "goal": "(and"})_").substr(0, 1), "P");
  EXPECT_EQ(code(R"_({"request": "resume"})_"), "X0008");
  EXPECT_EQ(code(R"_({"request": "start"})_"), "X0008") << "it begins by itself";
  EXPECT_EQ(code(R"_({"request": "cancel_what_if", "id": "7f"})_"), "X0008") << "nobody has asked";
}

TEST_F(ExecutiveRequests, WhenAnotherMissionWouldTakeIt_ThenThisOneDoesNot) {
  for (const char* text :
       {R"_({"request": "halt"})_", R"_({"request": "unblock", "name": "spill"})_",
        R"_({"request": "order", "name": "box", "from": "dock", "to": "rack", "amount": 1})_"})
    EXPECT_EQ(code(text), "X0003") << text;
}

TEST_F(ExecutiveRequests, WhenSomethingThatBelongsToThemIsMissingOrWrong_ThenTheyAreNone) {
  for (const char* text :
       {R"_({"request": "goal"})_", R"_({"request": "goal", "goal": 4})_",
        R"_({"request": "start", "goal": 4})_", R"_({"request": "what_if", "goal": ["(is-at v1 f1)"]})_",
        R"_({"request": "what_if", "goal": "(is-at v1 f1)", "id": 7})_",
        R"_({"request": "cancel_what_if", "id": {}})_", R"_({"request": "change"})_",
        R"_({"request": "change", "fluent": "(demand c1)"})_",
        R"_({"request": "change", "fluent": 3, "value": 8})_",
        R"_({"request": "change", "fluent": [], "value": 8})_",
        R"_({"request": "change", "fluent": "(demand c1)", "value": "8"})_"})
    EXPECT_EQ(code(text), "X0005") << text;
}

TEST_F(ExecutiveRequests, WhenTheRunIsOver_ThenQuestionsAreAnsweredAndAnotherOneCanBeStarted) {
  executive_.request_abort();
  EXPECT_EQ(executive_.run().phase, run::Phase::Safe);
  for (const char* word : {"abort", "hold", "resume"})
    EXPECT_EQ(code(std::string(R"_({"request": ")_") + word + "\"}"), "X0008") << word;
  EXPECT_EQ(code(R"_({"request": "change", "fluent": "(demand c1)", "value": 8})_"), "X0008");
  EXPECT_EQ(code(R"_({"request": "what_if", "id": "7f", "goal": "(is-at v1 f1)"})_"), "");
  EXPECT_EQ(code(R"_({"request": "start", "goal": "(is-at v1 f1)"})_"), "");
  EXPECT_FALSE(executive_.over());
}

TEST_F(ExecutiveRequests, WhenViewersLook_ThenTheFormIsThereAndTheOutlookIsToldOnce) {
  EXPECT_EQ(nlohmann::json::parse(executive_.goal_form())["available"], true);
  EXPECT_TRUE(executive_.new_outlook().has_value());
  EXPECT_FALSE(executive_.new_outlook().has_value());
}

}  // namespace
}  // namespace stepwright::executive

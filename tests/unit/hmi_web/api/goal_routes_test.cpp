// Goals by way of the guard: what is asked of the supervisor, what the trail says, what a supervisor may say.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

class GoalRoutesTest : public testing::Test, protected RequestGuardFixture {
 protected:
  json last_entry() const {
    std::ifstream in(audit->file());
    json last;
    for (std::string line; std::getline(in, line);) last = json::parse(line);
    return last;
  }
  static std::string code(const Answer& answer) { return json::parse(answer.text)["problems"][0]["code"]; }
};

TEST_F(GoalRoutesTest, WhenAnOperatorAsks_ThenTheSupervisorIsAskedAndTheTrailHasTheGoal) {
  const auto opened = session(Role::Operator);
  const auto status = [&](const char* path, const json& body) {
    return ask("POST", path, body.dump(), opened).status;
  };
  EXPECT_EQ(status("/api/plan/what-if", {{"goal", "(is-at v1 f1)"}, {"id", "7f"}}), 200u);
  EXPECT_EQ(last_entry()["action"], "plan.what_if");
  EXPECT_NE(last_entry()["after"].get<std::string>().find("(is-at v1 f1)"), std::string::npos);
  EXPECT_EQ(status("/api/plan/what-if/cancel", {{"id", "7f"}}), 200u);
  EXPECT_EQ(status("/api/plan/start", {{"goal", "(is-at v1 a1)"}, {"reason", "shift"}}), 200u);
  EXPECT_EQ(last_entry()["action"], "plan.start");
  EXPECT_EQ(last_entry()["reason"], "shift");
  EXPECT_EQ(status("/api/plan/start", json::object()), 200u);
  const auto asked = cell.asked();
  ASSERT_EQ(asked.size(), 4u);
  EXPECT_EQ(json::parse(asked[0]), json({{"request", "what_if"}, {"goal", "(is-at v1 f1)"}, {"id", "7f"}}));
  EXPECT_EQ(json::parse(asked[1]), json({{"request", "cancel_what_if"}, {"id", "7f"}}));
  EXPECT_EQ(json::parse(asked[2]), json({{"request", "start"}, {"goal", "(is-at v1 a1)"}}));
  EXPECT_EQ(json::parse(asked[3]), json({{"request", "start"}}));
}

TEST_F(GoalRoutesTest, WhenSomethingIsForced_ThenNothingIsStarted) {
  const auto opened = session(Role::Operator);
  ASSERT_TRUE(forces->force({"MAIN.valve", "TRUE", std::chrono::minutes(15), "emil", "test"}));
  const Answer refusal = ask("POST", "/api/plan/start", "{}", opened);
  EXPECT_EQ(refusal.status, 409u);
  EXPECT_EQ(code(refusal), "H0065");
  EXPECT_NE(refusal.text.find("MAIN.valve is forced"), std::string::npos) << refusal.text;
  EXPECT_TRUE(last_entry()["result"].get<std::string>().starts_with("refused: H0065")) << last_entry();
  ASSERT_TRUE(forces->unforce("MAIN.valve"));
  EXPECT_EQ(ask("POST", "/api/plan/start", "{}", opened).status, 200u);
}

TEST_F(GoalRoutesTest, WhenTheBodyIsWrong_ThenItIsRefused) {
  const auto opened = session(Role::Operator);
  const auto refusal = [&](const char* path, const json& body) {
    return code(ask("POST", path, body.dump(), opened));
  };
  EXPECT_EQ(refusal("/api/plan/what-if", {{"goal", "(is-at v1 f1)"}}), "H0032");
  EXPECT_EQ(refusal("/api/plan/what-if", {{"goal", ""}, {"id", "7"}}), "H0033");
  EXPECT_EQ(refusal("/api/plan/start", {{"goal", std::string(8'193, 'x')}}), "H0033");
  EXPECT_TRUE(cell.asked().empty());
}

TEST_F(GoalRoutesTest, WhenASupervisorSaysSomething_ThenOnlyObjectsThatAreNotNestedDeeplyGetThrough) {
  const auto opened = session(Role::Viewer);
  EXPECT_EQ(code(ask("GET", "/api/plan/goal-form", "", opened)), "H0064");
  cell.say(json{{"available", true}}.dump(), json{{"goal", "(is-at v1 f1)"}}.dump());
  EXPECT_EQ(json::parse(ask("GET", "/api/plan/goal-form", "", opened).text)["available"], true);
  EXPECT_EQ(json::parse(ask("GET", "/api/plan/outlook", "", opened).text)["goal"], "(is-at v1 f1)");
  for (const std::string& wrong :
       {std::string("7"), std::string("[1]"), std::string("{"), std::string("\xff")}) {
    cell.say(wrong, wrong);
    EXPECT_EQ(ask("GET", "/api/plan/goal-form", "", opened).status, 404u) << wrong;
  }
  const std::string deep = "{\"a\": " + std::string(200'000, '[') + std::string(200'000, ']') + "}";
  cell.say(deep, deep);
  EXPECT_LT(ask("GET", "/api/plan/outlook", "", opened).text.size(), 1'000u);
}

}  // namespace
}  // namespace stepwright::api

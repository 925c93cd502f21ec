#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "hmi_web/access/durable_file.h"
#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

class AlarmRoutesTest : public testing::Test {
 protected:
  Answer act(const std::string& what, const std::string& body, Role role = Role::Operator) {
    return fixture_.ask("POST", "/api/alarms/" + what, body, fixture_.session(role));
  }
  std::vector<json> trail() {
    std::vector<json> entries;
    std::istringstream lines(*access::read_whole(fixture_.audit->file()));
    for (std::string line; std::getline(lines, line);) entries.push_back(json::parse(line));
    return entries;
  }
  RequestGuardFixture fixture_;
};

TEST_F(AlarmRoutesTest, WhenAnAlarmIsAcknowledged_ThenItIsDoneInTheNameOfWhoeverAskedAndAudited) {
  const Answer answer = act("acknowledge", R"({"name": "a1.high", "reason": "seen"})");
  EXPECT_EQ(answer.status, 200u) << answer.text;
  EXPECT_EQ(json::parse(answer.text), (json{{"name", "a1.high"}, {"state", "acknowledged"}}));
  ASSERT_EQ(fixture_.records.actions.size(), 1u);
  const AlarmAction& action = fixture_.records.actions[0];
  EXPECT_EQ(action.alarm, "a1.high");
  EXPECT_EQ(action.event, "acknowledge");
  EXPECT_EQ(action.user, "operator");
  EXPECT_EQ(action.comment, "seen");
  const auto entries = trail();
  ASSERT_EQ(entries.size(), 2u) << "one before and one after";
  EXPECT_EQ(entries[1]["action"], "alarm.acknowledge");
  EXPECT_EQ(entries[1]["target"], "a1.high");
  EXPECT_EQ(entries[1]["before"], "unacknowledged");
  EXPECT_EQ(entries[1]["after"], "acknowledged");
  EXPECT_EQ(entries[1]["reason"], "seen");
  EXPECT_EQ(entries[1]["result"], "done");
}

TEST_F(AlarmRoutesTest, WhenAnActionIsAskedFor_ThenItIsThatEventOfTheAlarm) {
  const std::map<std::string, std::string> events = {
      {"reset", "reset"},           {"unshelve", "unshelve"},          {"suppress", "suppress"},
      {"unsuppress", "unsuppress"}, {"remove", "remove from service"}, {"return", "return to service"}};
  for (const auto& [path, event] : events) {
    EXPECT_EQ(act(path, R"({"name": "a", "reason": "works"})", Role::Engineer).status, 200u) << path;
    EXPECT_EQ(fixture_.records.actions.back().event, event);
  }
  EXPECT_EQ(act("shelve", R"({"name": "a", "reason": "works", "minutes": 45})").status, 200u);
  EXPECT_EQ(fixture_.records.actions.back().event, "shelve");
  EXPECT_EQ(fixture_.records.actions.back().shelve_for, std::chrono::minutes(45));
  EXPECT_NE(trail().back()["after"].get<std::string>().find("for 45 min"), std::string::npos);
}

TEST_F(AlarmRoutesTest, WhenWhatHidesAnAlarmHasNoReasonOrNoEnd_ThenItIsRefused) {
  for (const char* path : {"shelve", "suppress", "remove"})
    EXPECT_EQ(act(path, R"({"name": "a", "minutes": 5})", Role::Engineer).status, 400u) << path;
  for (const char* minutes : {"0", "-3", "10081", "\"5\"", "1e99"})
    EXPECT_EQ(
        act("shelve", std::string(R"({"name": "a", "reason": "works", "minutes": )") + minutes + "}").status,
        400u)
        << minutes;
  EXPECT_EQ(act("shelve", R"({"name": "a", "reason": "works"})").status, 400u);
  EXPECT_TRUE(fixture_.records.actions.empty());
}

TEST_F(AlarmRoutesTest, WhenTheAlarmDoesNotAllowIt_ThenTheStatusSaysSoAndTheTrailToo) {
  for (const auto& [code, status] :
       {std::pair("C0606", 409u), std::pair("C0607", 404u), std::pair("S0003", 503u)}) {
    fixture_.records.failure = code;
    EXPECT_EQ(act("acknowledge", R"({"name": "a"})").status, status) << code;
    EXPECT_EQ(trail().back()["result"], std::string("refused: ") + code + ": as the test wants it");
  }
}

TEST_F(AlarmRoutesTest, WhenHistoryIsAskedFor_ThenTheParametersOfTheRowAreHandedOver) {
  const access::OpenedSession viewer = fixture_.session(Role::Viewer);
  fixture_.ask("GET", "/api/history/trend?tags=a%3Bpoints%2Fb&columns=5", {}, viewer);
  fixture_.ask("GET", "/api/alarms?all=1", {}, viewer);
  fixture_.ask("GET", "/api/alarms/journal?alarm=x%20y&most=3", {}, viewer);
  EXPECT_EQ(fixture_.records.asked, (std::vector<std::string>{"trend columns=5 tags=a;points/b",
                                                              "alarms all=1", "journal alarm=x y most=3"}));
}

TEST_F(AlarmRoutesTest, WhenAParameterIsUnknown_ThenItIsRefusedByItsName) {
  const access::OpenedSession viewer = fixture_.session(Role::Viewer);
  const Answer misspelt = fixture_.ask("GET", "/api/history/trend?tag=Main.level", {}, viewer);
  EXPECT_EQ(misspelt.status, 400u);
  const json problem = json::parse(misspelt.text)["problems"][0];
  EXPECT_EQ(problem["code"], "H0060");
  EXPECT_EQ(problem["message"], "there is no parameter 'tag'");
  EXPECT_EQ(problem["hint"], "did you mean 'tags'?");
  const Answer none = fixture_.ask("GET", "/api/history/tags?tags=a", {}, viewer);
  EXPECT_EQ(json::parse(none.text)["problems"][0]["hint"], "none");
  EXPECT_TRUE(fixture_.records.asked.empty());
}

TEST_F(AlarmRoutesTest, WhenAPageFollowsTheHistoryByItself_ThenItsSessionEndsIdleAllTheSame) {
  const access::OpenedSession viewer = fixture_.session(Role::Viewer);
  const auto idle = fixture_.control->sessions().limits().idle;
  fixture_.now += idle / 2;
  EXPECT_EQ(fixture_.ask("GET", "/api/history/tags", {}, viewer).status, 200u);
  fixture_.now += idle / 2 + std::chrono::seconds(1);
  EXPECT_EQ(fixture_.ask("GET", "/api/history/tags", {}, viewer).status, 401u);
  const access::OpenedSession other = fixture_.session(Role::Viewer);
  fixture_.now += idle / 2;
  EXPECT_EQ(fixture_.ask("GET", "/api/forces", {}, other).status, 200u);
  fixture_.now += idle / 2 + std::chrono::seconds(1);
  EXPECT_EQ(fixture_.ask("GET", "/api/history/tags", {}, other).status, 200u)
      << "what a person asks for counts";
}

TEST(RecordRoutes, WhenTheServerKeepsNothing_ThenEveryRowSaysSo) {
  for (const auto& rows : {record_routes({}), alarm_routes({})}) {
    for (const Route& row : rows) {
      const Answer answer = row.handler({});
      EXPECT_EQ(answer.status, 404u) << row.name;
      EXPECT_EQ(json::parse(answer.text)["problems"][0]["code"], "H0062");
    }
  }
}

TEST(FigureRoutes, WhenTheServerFollowsNoRuntime_ThenItSaysSo) {
  const Answer answer = figure_routes({}).front().handler({});
  EXPECT_EQ(answer.status, 404u);
  EXPECT_EQ(json::parse(answer.text)["problems"][0]["code"], "H0063");
}

}  // namespace
}  // namespace stepwright::api

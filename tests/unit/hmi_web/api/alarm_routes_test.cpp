#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "runtime/ground/files/files.h"
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
    std::istringstream lines(files::read_file(fixture_.audit->file()).value());
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

TEST_F(AlarmRoutesTest, WhenAllInSightAreAcknowledged_ThenEachIsCheckedAndAuditedByItself) {
  fixture_.records.refused_alarm = "b.high";
  const Answer answer =
      act("acknowledge-all", R"({"names": ["a.high", "b.high", "c.low"], "reason": "seen"})");
  EXPECT_EQ(answer.status, 200u) << answer.text;
  const json told = json::parse(answer.text);
  EXPECT_EQ(told["done"], (json::array({{{"name", "a.high"}, {"state", "acknowledged"}},
                                        {{"name", "c.low"}, {"state", "acknowledged"}}})));
  ASSERT_EQ(told["refused"].size(), 1u);
  EXPECT_EQ(told["refused"][0]["name"], "b.high");
  EXPECT_EQ(told["refused"][0]["code"], "C0606");
  ASSERT_EQ(fixture_.records.actions.size(), 2u);
  EXPECT_EQ(fixture_.records.actions[1].user, "operator");
  EXPECT_EQ(fixture_.records.actions[1].comment, "seen");
  const auto entries = trail();
  ASSERT_EQ(entries.size(), 5u) << "one before, one of each, one after";
  EXPECT_EQ(entries[1]["action"], "alarm.acknowledge");
  EXPECT_EQ(entries[1]["target"], "a.high");
  EXPECT_EQ(entries[1]["before"], "unacknowledged");
  EXPECT_EQ(entries[1]["result"], "done");
  EXPECT_EQ(entries[2]["target"], "b.high");
  EXPECT_EQ(entries[2]["result"], "refused: C0606: as the test wants it");
  EXPECT_EQ(entries[4]["action"], "alarm.acknowledge_all");
  EXPECT_EQ(entries[4]["after"], "2 acknowledged");
}

TEST_F(AlarmRoutesTest, WhenNothingOrTooMuchIsInSight_ThenTheRequestIsRefused) {
  EXPECT_EQ(act("acknowledge-all", R"({"names": []})").status, 400u);
  json many = {{"names", std::vector<std::string>(201, "a")}};
  EXPECT_EQ(act("acknowledge-all", many.dump()).status, 400u);
  EXPECT_EQ(act("acknowledge-all", R"({"names": ["a"]})", Role::Viewer).status, 403u);
  EXPECT_TRUE(fixture_.records.actions.empty());
}

TEST_F(AlarmRoutesTest, WhenTheTrailIsSearched_ThenOnlyWhatMatchesIsThere) {
  act("acknowledge", R"({"name": "a.high", "reason": "seen at the pump"})");
  act("shelve", R"({"name": "b.low", "reason": "works", "minutes": 5})");
  act("reset", R"({"name": "a.high"})", Role::Engineer);
  const auto found = [&](const std::string& query) {
    const Answer answer = fixture_.ask("GET", "/api/audit?" + query, {}, fixture_.session(Role::Engineer));
    EXPECT_EQ(answer.status, 200u) << answer.text;
    const json page = json::parse(answer.text);
    std::string actions;
    for (const json& entry : page["entries"])
      if (entry["result"] == "done") actions += entry["action"].get<std::string>() + " ";
    EXPECT_EQ(page["next_before"], 0);
    return actions;
  };
  EXPECT_EQ(found("user=OPERATOR"), "alarm.shelve alarm.acknowledge ");
  EXPECT_EQ(found("user=PERAT"), "alarm.shelve alarm.acknowledge ");
  EXPECT_EQ(found("user=engi"), "alarm.reset ");
  EXPECT_EQ(found("target=a.hi"), "alarm.reset alarm.acknowledge ");
  EXPECT_EQ(found("text=PUMP"), "alarm.acknowledge ");
  EXPECT_EQ(found("text=shelve&user=operator"), "alarm.shelve ");
  EXPECT_EQ(found("to_ms=1000"), "");
  EXPECT_EQ(found("from_ms=1000&target=b.low"), "alarm.shelve ");
  EXPECT_EQ(fixture_.ask("GET", "/api/audit?from_ms=soon", {}, fixture_.session(Role::Engineer)).status,
            400u);
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

TEST_F(AlarmRoutesTest, WhenATestIsAskedFor_ThenItsChannelSendsItAndOthersAreNotKnown) {
  const access::OpenedSession operates = fixture_.session(Role::Operator);
  EXPECT_EQ(fixture_.ask("POST", "/api/notifications/test", R"({"name": "shift"})", operates).status, 200u);
  EXPECT_EQ(fixture_.notifications.testers, (std::vector<std::string>{"operator"}));
  EXPECT_EQ(trail().back()["action"], "notification.test");
  EXPECT_EQ(fixture_.ask("POST", "/api/notifications/test", R"({"name": "night"})", operates).status, 404u);
  const json list = json::parse(fixture_.ask("GET", "/api/notifications", {}, operates).text);
  EXPECT_EQ(list["notifications"][0]["problem"], "no answer");
  EXPECT_TRUE(list["notifications"][0]["sent_ms"].is_null());
}

TEST(NotifyRoutes, WhenTheCellNotifiesNobody_ThenTheListIsEmptyAndATestIsRefused) {
  const auto rows = notify_routes({});
  EXPECT_EQ(rows[0].handler({}).text, R"({"notifications":[]})");
  EXPECT_EQ(rows[1].handler({}).status, 404u);
}

class TrendRoutesTest : public AlarmRoutesTest {};

TEST_F(TrendRoutesTest, WhenAGroupIsSaved_ThenEverybodyHasItWithWhoAndWhen) {
  const access::OpenedSession operates = fixture_.session(Role::Operator);
  const char* body =
      R"({"tags": ["points/a1.level", "Main.pump"], "axes": {"points/a1.level": "0..100"}, "span_s": 600})";
  EXPECT_EQ(fixture_.ask("PUT", "/api/trends/filling%20and%20more", body, operates).status, 200u);
  const auto entries = trail();
  EXPECT_EQ(entries.back()["action"], "trend.save");
  EXPECT_EQ(entries.back()["target"], "filling and more");
  EXPECT_EQ(entries.back()["after"], "points/a1.level (0..100); Main.pump");
  const json groups =
      json::parse(fixture_.ask("GET", "/api/trends", {}, fixture_.session(Role::Viewer)).text)["groups"];
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0]["tags"], (json{"points/a1.level", "Main.pump"}));
  EXPECT_EQ(groups[0]["axes"], (json{{"points/a1.level", "0..100"}}));
  EXPECT_EQ(groups[0]["saved_by"], "operator");
  EXPECT_GT(groups[0]["saved_ms"].get<double>(), 1.7e12);
  EXPECT_EQ(fixture_.ask("DELETE", "/api/trends/filling%20and%20more", {}, operates).status, 200u);
  EXPECT_EQ(fixture_.ask("DELETE", "/api/trends/filling%20and%20more", {}, operates).status, 404u);
}

TEST_F(TrendRoutesTest, WhenAGroupCannotBeOne_ThenItIsRefused) {
  const access::OpenedSession operates = fixture_.session(Role::Operator);
  const auto status = [&](const char* body) {
    return fixture_.ask("PUT", "/api/trends/x", body, operates).status;
  };
  EXPECT_EQ(status(R"({"tags": [], "span_s": 600})"), 400u);
  EXPECT_EQ(status(R"({"tags": ["a", "a"], "span_s": 600})"), 400u);
  EXPECT_EQ(status(R"({"tags": ["a"], "axes": {"a": "5..1"}, "span_s": 600})"), 400u);
  EXPECT_EQ(status(R"({"tags": ["a"], "span_s": 0})"), 400u);
  EXPECT_EQ(
      fixture_.ask("PUT", "/api/trends/x", R"({"tags": ["a"], "span_s": 60})", fixture_.session(Role::Viewer))
          .status,
      403u);
}

TEST(WallDisplay, WhenItsAddressIsNamed_ThenItLooksWithoutLoggingInAndNeverActs) {
  RequestGuardFixture fixture(Role::None, [](const std::string& peer) { return peer == "10.0.0.17"; });
  const auto status = [&](const char* method, const char* target, const char* peer, const char* body = "") {
    Request request;
    request.method = method;
    request.target = target;
    request.content_type = "application/json";
    request.own_origin = true;
    request.peer = peer;
    return fixture.ask(request, body).status;
  };
  EXPECT_EQ(status("GET", "/api/alarms", "10.0.0.17"), 200u);
  EXPECT_EQ(status("GET", "/api/alarms", "10.0.0.18"), 401u);
  EXPECT_EQ(status("GET", "/api/audit", "10.0.0.17"), 401u) << "it is a viewer, no more";
  EXPECT_EQ(status("POST", "/api/alarms/acknowledge", "10.0.0.17", R"({"name": "a"})"), 401u);
  EXPECT_EQ(status("PUT", "/api/session/password", "10.0.0.17", R"({"present": "a", "password": "b"})"),
            403u);
  EXPECT_TRUE(fixture.records.actions.empty());
}

TEST(RecordRoutes, WhenTheServerKeepsNothing_ThenEveryRowSaysSo) {
  for (const auto& rows : {record_routes({}), alarm_routes({}), trend_routes({})}) {
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

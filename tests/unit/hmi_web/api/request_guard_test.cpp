#include "hmi_web/api/request_guard.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "hmi_web/access/audit_chain.h"
#include "hmi_web/access/audit_files.h"
#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

class RequestGuardTest : public testing::Test, protected RequestGuardFixture {
 protected:
  // The trail, an entry an element.
  json trail() const {
    audit->settle();
    std::ifstream in(audit->file());
    json list = json::array();
    for (std::string line; std::getline(in, line);) list.push_back(json::parse(line));
    return list;
  }
  static std::string code(const Answer& answer) { return json::parse(answer.text)["problems"][0]["code"]; }
  void claim() {
    const json body = {{"token", *control->setup_token()}, {"name", "root"}, {"password", kPassword}};
    ASSERT_EQ(ask("POST", "/api/setup", body.dump()).status, 200u);
  }
};

TEST_F(RequestGuardTest, WhenSomebodyLogsIn_ThenTheAnswerHasCookieAndTokenAndTheTrailTellsOfIt) {
  EXPECT_EQ(json::parse(ask("GET", "/api/session").text)["setup_needed"], true);
  claim();
  const Answer answer = ask("POST", "/api/session", R"({"name": "root", "password": "correct horse"})");
  ASSERT_EQ(answer.status, 200u) << answer.text;
  const json session = json::parse(answer.text);
  EXPECT_EQ(session["user"], "root");
  EXPECT_EQ(session["role"], "administrator");
  EXPECT_EQ(session["setup_needed"], false);
  const access::OpenedSession opened{answer.set_cookie, session["csrf"]};
  EXPECT_EQ(json::parse(ask("GET", "/api/session", "", opened).text)["user"], "root");
  EXPECT_EQ(ask("DELETE", "/api/session", "", opened).set_cookie, "-");
  EXPECT_EQ(json::parse(ask("GET", "/api/session", "", opened).text)["user"], "");
  ASSERT_EQ(trail().size(), 3u);
  EXPECT_EQ(trail()[0]["action"], "session.claim");
  EXPECT_EQ(trail()[1]["user"], "root");
  EXPECT_EQ(trail()[2]["action"], "session.logout");
  audit->settle();
  std::ifstream in(audit->file());
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(text.find(kPassword), std::string::npos) << "no password is ever written down";
}

TEST_F(RequestGuardTest, WhenTheSessionIsIdleForLong_ThenItIsNobodys) {
  const auto opened = session(Role::Administrator);
  EXPECT_EQ(ask("GET", "/api/users", "", opened).status, 200u);
  now += control->sessions().limits().idle;
  EXPECT_EQ(ask("GET", "/api/users", "", opened).status, 401u);
}

TEST_F(RequestGuardTest, WhenPasswordsAreGuessed_ThenItIsToldWhenToComeBackAndTheTrailDoesNotGrow) {
  session(Role::Operator);
  const std::string wrong = R"({"name": "operator", "password": "wrong"})";
  for (int i = 0; i < 5; ++i) EXPECT_EQ(ask("POST", "/api/session", wrong).status, 401u);
  const std::size_t told = trail().size();
  EXPECT_EQ(told, 5u);
  const Answer locked = ask("POST", "/api/session", wrong);
  EXPECT_EQ(locked.status, 429u);
  EXPECT_GT(locked.retry_after.count(), 0);
  EXPECT_EQ(trail().size(), told);
  EXPECT_EQ(trail()[0]["target"], "operator");
  EXPECT_NE(trail()[0]["result"].get<std::string>().find("H0026"), std::string::npos);
}

TEST_F(RequestGuardTest, WhenAnOperatorAborts_ThenTheSupervisorHearsItAndTheTrailHasItTwice) {
  const auto opened = session(Role::Operator);
  EXPECT_EQ(ask("POST", "/api/plan/abort", R"({"reason": "smoke"})", opened).status, 200u);
  EXPECT_EQ(cell.asked(), std::vector<std::string>{R"({"request":"abort"})"});
  ASSERT_EQ(trail().size(), 2u);
  EXPECT_EQ(trail()[0]["result"], "begun");
  EXPECT_EQ(trail()[1]["result"], "done");
  EXPECT_EQ(trail()[1]["reason"], "smoke");
  EXPECT_EQ(trail()[1]["user"], "operator");
}

TEST_F(RequestGuardTest, WhenRequestsAreMadeOfForms_ThenTheyAreWhatTheSupervisorReads) {
  const auto opened = session(Role::Operator);
  ask("POST", "/api/plan/goal", R"_({"goal": "(= (level a1) 4)"})_", opened);
  ask("POST", "/api/plan/change", R"_({"fluent": "(demand c1)", "value": 8})_", opened);
  ask("POST", "/api/fleet/order", R"({"name": "o", "from": "a", "to": "b", "amount": 3})", opened);
  ask("POST", "/api/fleet/block", R"({"name": "p", "corners_m": [[0, 0], [1, 0], [1, 1.5]]})", opened);
  ask("POST", "/api/fleet/block", R"({"name": "press"})", opened);
  ask("POST", "/api/fleet/unblock", R"({"name": "p"})", opened);
  ask("POST", "/api/fleet/return", R"({"vehicle": "t"})", opened);
  ask("POST", "/api/runtime/stop", R"({"reason": "smoke"})", opened);
  ask("POST", "/api/plan/hold", "{}", opened);
  ask("POST", "/api/plan/resume", R"({"reason": "clear"})", opened);
  const auto asked = cell.asked();
  ASSERT_EQ(asked.size(), 10u);
  EXPECT_EQ(json::parse(asked[8]), json({{"request", "hold"}}));
  EXPECT_EQ(json::parse(asked[9]), json({{"request", "resume"}}));
  EXPECT_EQ(json::parse(asked[0]), json({{"request", "goal"}, {"goal", "(= (level a1) 4)"}}));
  EXPECT_EQ(json::parse(asked[1]), json({{"request", "change"}, {"fluent", "(demand c1)"}, {"value", 8.0}}));
  EXPECT_EQ(json::parse(asked[2]),
            json({{"request", "order"}, {"name", "o"}, {"from", "a"}, {"to", "b"}, {"amount", 3}}));
  EXPECT_TRUE(json::parse(asked[2])["amount"].is_number_unsigned());
  EXPECT_EQ(json::parse(asked[3])["corners_m"], json({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.5}}));
  EXPECT_EQ(json::parse(asked[4]), json({{"request", "block"}, {"name", "press"}})) << "out of service";
  EXPECT_EQ(asked[7], "stop operator: smoke");
}

TEST_F(RequestGuardTest, WhenNobodyAnswers_ThenItIsSaidSo) {
  const auto opened = session(Role::Operator);
  cell.fail_with("D0001");
  const Answer answer = ask("POST", "/api/plan/abort", "{}", opened);
  EXPECT_EQ(answer.status, 503u);
  EXPECT_EQ(code(answer), "D0001");
  EXPECT_NE(trail()[1]["result"].get<std::string>().find("refused: D0001: "), std::string::npos);
}

TEST_F(RequestGuardTest, WhenTheSupervisorRefusesOrDoesNotAnswer_ThenPageAndTrailHaveItsReason) {
  const auto opened = session(Role::Operator);
  const auto last = [&] { return trail().back()["result"].get<std::string>(); };
  cell.fail_with("X0008");
  EXPECT_EQ(ask("POST", "/api/plan/hold", "{}", opened).status, 409u);
  EXPECT_TRUE(last().starts_with("refused: X0008: ")) << last();
  cell.fail_with("X0003");
  EXPECT_EQ(ask("POST", "/api/fleet/return", R"({"vehicle": "t"})", opened).status, 400u);
  EXPECT_EQ(trail().back()["target"], "t");
  cell.fail_with("D0007");
  EXPECT_EQ(ask("POST", "/api/plan/resume", "{}", opened).status, 504u);
  EXPECT_TRUE(last().starts_with("refused: D0007: ")) << last();
}

// No file of this process grows while it lives.
class FullDisk {
 public:
  FullDisk() : ignored_(::signal(SIGXFSZ, SIG_IGN)) {
    EXPECT_EQ(::getrlimit(RLIMIT_FSIZE, &before_), 0);
    const rlimit none{0, before_.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &none), 0);
  }
  ~FullDisk() {
    EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &before_), 0);
    ::signal(SIGXFSZ, ignored_);
  }

 private:
  rlimit before_{};
  sighandler_t ignored_;
};

TEST_F(RequestGuardTest, WhenTheTrailCannotBeWritten_ThenNothingIsDone) {
  const auto opened = session(Role::Operator);
  {
    const FullDisk full;
    for (const auto& [target, body] : {std::pair("/api/plan/goal", R"_({"goal": "(= (level a1) 4)"})_"),
                                       std::pair("/api/plan/resume", "{}")}) {
      const Answer answer = ask("POST", target, body, opened);
      EXPECT_EQ(answer.status, 503u);
      EXPECT_EQ(code(answer), "H0046");
    }
  }
  EXPECT_TRUE(cell.asked().empty());
}

TEST_F(RequestGuardTest, WhenAPasswordIsMistyped_ThenTheSessionThatThereIsGoesOn) {
  claim();
  const auto opened = session(Role::Operator);
  EXPECT_EQ(ask("POST", "/api/session", R"({"name": "operator", "password": "mistyped it"})", opened).status,
            401u);
  EXPECT_EQ(json::parse(ask("GET", "/api/session", "", opened).text)["user"], "operator");
  EXPECT_EQ(
      ask("POST", "/api/session", R"({"name": "operator", "password": "correct horse"})", opened).status,
      200u);
  EXPECT_EQ(json::parse(ask("GET", "/api/session", "", opened).text)["user"], "")
      << "the other one took its place";
}

TEST_F(RequestGuardTest, WhenServersShareAHost_ThenEachHasACookieOfItsOwn) {
  EXPECT_NE(cookie_at(8080), cookie_at(8081));
  RequestGuardOptions options;
  options.cookie = cookie_at(8080);
  const RequestGuard other(*table, *control, *audit, options);
  const auto opened = session(Role::Viewer);
  const std::string both = cookie_at(8081) + "=somebody-elses; " + cookie_at(8080) + "=" + opened.token;
  const Request request{"GET", "/api/session", both, "", "", false, "127.0.0.1", true};
  EXPECT_EQ(other.admit(request).call.who.user, "viewer");
}

TEST_F(RequestGuardTest, WhenTheCalendarHasJumped_ThenAnEngineerAcceptsItOnce) {
  const auto engineer = session(Role::Engineer);
  EXPECT_EQ(ask("POST", "/api/history/calendar", "{}", session(Role::Operator)).status, 403u);
  EXPECT_EQ(ask("POST", "/api/history/calendar", R"({"reason": "new battery"})", engineer).status, 200u);
  EXPECT_EQ(code(ask("POST", "/api/history/calendar", "{}", engineer)), "H0069");
  EXPECT_EQ(trail().back()["action"], "history.accept_calendar");
}

TEST_F(RequestGuardTest, WhenABodyIsWrong_ThenTheAnswerHasThePlace) {
  const auto opened = session(Role::Operator);
  const Answer answer = ask("POST", "/api/plan/goal", "{\"gaol\": \"x\"}", opened);
  EXPECT_EQ(answer.status, 400u);
  const json problem = json::parse(answer.text)["problems"][0];
  EXPECT_EQ(problem["code"], "H0031");
  EXPECT_EQ(problem["line"], 1);
  EXPECT_EQ(problem["column"], 7);
  EXPECT_EQ(problem["hint"], "did you mean 'goal'?");
  EXPECT_EQ(ask("DELETE", "/api/session", "{}", opened).status, 400u) << "a body where there is none";
}

TEST_F(RequestGuardTest, WhenABodyIsNoJson_ThenItIsRefusedByItsType) {
  const auto opened = session(Role::Operator);
  const std::string cookie = std::string(kSessionCookie) + "=" + opened.token;
  Request request{"POST", "/api/plan/abort", cookie, opened.csrf, "text/plain", true, "", true};
  EXPECT_EQ(guard->admit(request).refusal.status, 415u);
  request.content_type = "application/json; charset=utf-8";
  EXPECT_NE(guard->admit(request).route, nullptr);
}

TEST_F(RequestGuardTest, WhenAnAdministratorKeepsUsers_ThenTheyAreListedAndTheTrailHasBeforeAndAfter) {
  const auto opened = session(Role::Administrator);
  const std::string user = R"({"name": "ada", "role": "operator", "password": "ada's secret"})";
  EXPECT_EQ(ask("POST", "/api/users", user, opened).status, 200u);
  const Answer again = ask("POST", "/api/users", user, opened);
  EXPECT_EQ(again.status, 409u);
  EXPECT_EQ(code(again), "H0029");
  EXPECT_NE(again.text.find("there is a user 'ada' already"), std::string::npos);
  EXPECT_EQ(ask("PUT", "/api/users/nobody/role", R"({"role": "engineer"})", opened).status, 404u);
  const auto hers = control->sessions().open("ada", Role::Operator, "");
  EXPECT_EQ(ask("PUT", "/api/users/ada/role", R"({"role": "engineer"})", opened).status, 200u);
  EXPECT_EQ(ask("GET", "/api/forces", "", hers).status, 401u) << "her session has ended";
  const json last = trail().back();
  EXPECT_EQ(last["action"], "user.role");
  EXPECT_EQ(last["target"], "ada");
  EXPECT_EQ(last["before"], "operator");
  EXPECT_EQ(last["after"], "engineer");
  EXPECT_EQ(ask("PUT", "/api/users/ada/password", R"({"password": "another one"})", opened).status, 200u);
  EXPECT_EQ(ask("DELETE", "/api/users/ada", "", opened).status, 200u);
  EXPECT_EQ(ask("DELETE", "/api/users/ada", "", opened).status, 404u);
  EXPECT_EQ(ask("DELETE", "/api/users/administrator", "", opened).status, 409u) << "the last one";
}

TEST_F(RequestGuardTest, WhenASessionIsRevoked_ThenItsListenersEndToo) {
  const auto opened = session(Role::Administrator);
  const auto other = session(Role::Viewer);
  Caller listener;
  listener.token = other.token;
  EXPECT_TRUE(guard->may_listen(listener));
  const json listed = json::parse(ask("GET", "/api/users", "", opened).text);
  for (const json& entry : listed["sessions"]) {
    if (entry["user"] != "viewer") continue;
    EXPECT_EQ(ask("DELETE", "/api/sessions/" + entry["id"].get<std::string>(), "", opened).status, 200u);
  }
  EXPECT_FALSE(guard->may_listen(listener));
}

TEST_F(RequestGuardTest, WhenTheAuditIsRead_ThenItComesInPagesAndAsFiles) {
  const auto opened = session(Role::Engineer);
  const auto operator_session = session(Role::Operator);
  for (int i = 0; i < 3; ++i) ask("POST", "/api/plan/abort", "{}", operator_session);
  audit->settle();
  const json page = json::parse(ask("GET", "/api/audit", "", opened).text);
  EXPECT_EQ(page["count"], 6);
  EXPECT_EQ(page["broken_line"], 0);
  EXPECT_EQ(page["entries"][0]["seq"], 6);
  EXPECT_EQ(json::parse(ask("GET", "/api/audit?before=3", "", opened).text)["entries"].size(), 2u);
  EXPECT_EQ(ask("GET", "/api/audit?before=x", "", opened).status, 400u);
  const Answer lines = ask("GET", "/api/audit/audit.jsonl", "", opened);
  EXPECT_EQ(access::check_chain(lines.text).entries, 6u);
  EXPECT_EQ(lines.file_name, "audit.jsonl");
  EXPECT_TRUE(ask("GET", "/api/audit/audit.csv", "", opened).text.starts_with("\xEF\xBB\xBFseq,"));
}

TEST_F(RequestGuardTest, WhenAnEngineerForces_ThenTheProgramIsAskedAndTheListSaysUntilWhen) {
  const auto opened = session(Role::Engineer);
  const std::string force =
      R"({"name": "MAIN.valve", "value": "TRUE", "reason": "commissioning", "minutes": 5})";
  EXPECT_EQ(ask("POST", "/api/tags/force", force, opened).status, 200u);
  const json listed = json::parse(ask("GET", "/api/forces", "", opened).text)["forces"];
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(listed[0]["name"], "MAIN.valve");
  EXPECT_EQ(listed[0]["user"], "engineer");
  EXPECT_EQ(listed[0]["until_s"].get<std::int64_t>() - listed[0]["since_s"].get<std::int64_t>(), 300);
  EXPECT_EQ(trail().back()["before"], "FALSE");
  EXPECT_EQ(trail().back()["after"], "TRUE");
  EXPECT_EQ(ask("POST", "/api/tags/unforce", R"({"name": "MAIN.valve", "reason": "done"})", opened).status,
            200u);
  EXPECT_EQ(cell.asked(), (std::vector<std::string>{"force MAIN.valve TRUE", "unforce MAIN.valve"}));
  EXPECT_EQ(code(ask("POST", "/api/tags/force", R"({"name": "MAIN.valve", "value": "TRUE"})", opened)),
            "H0032")
      << "a reason is needed";
}

TEST(RequestGuard, WhenLookingIsOpenAtThisMachine_ThenOnlyThereAndOnlyLooking) {
  RequestGuardFixture fixture(Role::Administrator);  // more than is ever given away
  EXPECT_EQ(json::parse(fixture.ask("GET", "/api/session").text)["role"], "viewer");
  EXPECT_EQ(fixture.ask("GET", "/api/forces").status, 200u);
  EXPECT_EQ(fixture.ask("POST", "/api/plan/abort", "{}").status, 401u);
  Request request{"GET", "/live", "", "", "", false, "10.0.0.7", false};
  EXPECT_EQ(fixture.guard->admit(request).refusal.status, 401u);
  request.peer_is_local = true;
  EXPECT_NE(fixture.guard->admit(request).route, nullptr);
}

TEST(RequestGuard, WhenCookiesAreManifold_ThenOurOwnIsFound) {
  RequestGuardFixture fixture;
  const auto opened = fixture.session(Role::Viewer);
  for (const std::string& cookie :
       {"a=b; __Host-stepwright=" + opened.token, "__Host-stepwright=" + opened.token + "; x=y",
        "  __Host-stepwright=" + opened.token + " ",
        ";;=;" + std::string("__Host-stepwright=") + opened.token}) {
    const Request request{"GET", "/api/forces", cookie, "", "", false, "", true};
    EXPECT_NE(fixture.guard->admit(request).route, nullptr) << cookie;
  }
  for (const std::string& cookie : {"x__Host-stepwright=" + opened.token, "__Host-stepwright" + opened.token,
                                    "__Host-stepwright2=" + opened.token, std::string(9'000, '=')}) {
    const Request request{"GET", "/api/forces", cookie, "", "", false, "", true};
    EXPECT_EQ(fixture.guard->admit(request).refusal.status, 401u) << cookie;
  }
}

}  // namespace
}  // namespace stepwright::api

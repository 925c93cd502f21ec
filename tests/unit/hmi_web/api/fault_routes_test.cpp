// Faults of a simulated plant by way of the guard: the list, what an engineer sets and ends, and what the
// trail has.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/unit/hmi_web/api/request_guard_fixture.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

class FaultRoutesTest : public testing::Test, protected RequestGuardFixture {
 protected:
  json trail() const {
    std::ifstream in(audit->file());
    json last;
    for (std::string line; std::getline(in, line);) last = json::parse(line);
    return last;
  }
  json fault(std::size_t index) {
    return json::parse(ask("GET", "/api/faults", {}, session(Role::Viewer)).text)["faults"][index];
  }
  Answer act(const char* path, const json& body, Role role = Role::Engineer) {
    return ask("POST", path, body.dump(), session(role));
  }
};

TEST_F(FaultRoutesTest, WhenAnEngineerSetsAndEndsOne_ThenThePlantHasItAndTheTrailBothValues) {
  EXPECT_EQ(fault(0), json({{"name", "t1.leak"},
                            {"unit", "percent/s"},
                            {"meaning", "it leaks"},
                            {"low", 0.0},
                            {"high", 5.0},
                            {"whole", false},
                            {"value", nullptr}}));
  EXPECT_EQ(act("/api/faults/set", {{"name", "t1.leak"}, {"value", 0.5}, {"reason", "a test"}}).status, 200u);
  EXPECT_EQ(fault(0)["value"], 0.5);
  EXPECT_EQ(trail()["action"], "fault.set");
  EXPECT_EQ(trail()["target"], "t1.leak");
  EXPECT_EQ(trail()["after"], "0.5");
  EXPECT_EQ(trail()["reason"], "a test");
  EXPECT_EQ(act("/api/faults/clear", {{"name", "t1.leak"}, {"reason", "it is over"}}).status, 200u);
  EXPECT_EQ(fault(0)["value"], nullptr);
  EXPECT_EQ(trail()["before"], "0.5");
  EXPECT_EQ(trail()["after"], "");
}

TEST_F(FaultRoutesTest, WhenItIsRefused_ThenNothingHoldsAndTheReasonIsTold) {
  const Answer unknown = act("/api/faults/set", {{"name", "t9"}, {"value", 1}, {"reason", "a test"}});
  EXPECT_GE(unknown.status, 400u);
  EXPECT_NE(unknown.text.find("C0311"), std::string::npos);
  EXPECT_TRUE(trail()["result"].get<std::string>().starts_with("refused: C0311")) << trail();
  EXPECT_GE(act("/api/faults/set", {{"name", "t1.leak"}, {"value", 9}, {"reason", "a test"}}).status, 400u);
  EXPECT_EQ(act("/api/faults/set", {{"name", "t1.leak"}, {"value", "much"}, {"reason", "a test"}}).status,
            400u);
  EXPECT_EQ(act("/api/faults/set", {{"name", "t1.leak"}, {"value", 1}}).status, 400u) << "a reason is wanted";
  EXPECT_EQ(act("/api/faults/set", {{"name", "t1.leak"}, {"value", 1}, {"reason", "a test"}}, Role::Operator)
                .status,
            403u);
  EXPECT_EQ(fault(0)["value"], nullptr);
}

TEST_F(FaultRoutesTest, WhenNobodyAnswers_ThenThatIsSaid) {
  cell.fail_with("D0001");
  const Answer answer = ask("GET", "/api/faults", {}, session(Role::Viewer));
  EXPECT_EQ(answer.status, 200u) << "pages ask again and again";
  const json told = json::parse(answer.text);
  EXPECT_EQ(told["answers"], false);
  EXPECT_EQ(told["problems"][0]["code"], "D0001");
  EXPECT_TRUE(told["faults"].empty());
}

}  // namespace
}  // namespace stepwright::api

#include "supervisor/fleet/vda5050/check_message.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/unit/supervisor/fleet/vda5050/sample_messages.h"

namespace stepwright::fleet::vda5050 {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

TEST(CheckMessage, Sample_WhenSound_ThenNothing) {
  for (const Topic topic : kTopics) {
    EXPECT_EQ(to_string(check_message(topic, sample_message(topic), "m")), "") << to_string(topic);
  }
}

// What is set at a pointer of a sound message (null: taken out), and what is said of it.
struct Case {
  Topic topic;
  std::string pointer;
  json value;
  std::string code;
  std::string message;
};

void expect_named(const Case& broken) {
  SCOPED_TRACE(std::string(to_string(broken.topic)) + broken.pointer + " " + broken.value.dump());
  json root = json::parse(sample_message(broken.topic));
  const json::json_pointer pointer(broken.pointer);
  if (broken.value.is_null()) {
    root.at(pointer.parent_pointer()).erase(pointer.back());
  } else {
    root[pointer] = broken.value;
  }
  const auto wrong = check_message(broken.topic, root.dump(), "the message");
  ASSERT_FALSE(wrong.empty());
  EXPECT_EQ(wrong.front().code, broken.code);
  EXPECT_THAT(wrong.front().message, HasSubstr(broken.message));
  EXPECT_EQ(wrong.front().where.file, "the message");
}

const json kTwoParameters = json::parse(R"([{"key": "a", "value": 1}, {"key": "a", "value": 2}])");
const json kTwoMaps = json::parse(R"([{"mapId": "m", "mapVersion": "1", "mapStatus": "ENABLED"},
                                      {"mapId": "m", "mapVersion": "2", "mapStatus": "ENABLED"}])");

TEST(CheckMessage, Shape_WhenOneThingIsWrong_ThenItIsNamedWithItsPlace) {
  const std::vector<Case> cases = {
      Case{Topic::Order, "/headerId", nullptr, "F0902", "the message: lacks 'headerId'"},
      Case{Topic::Order, "/headerId", -1, "F0903", "/headerId: -1 is not from 0 to 4294967295"},
      Case{Topic::Order, "/headerId", 4294967296, "F0903", "/headerId"},
      Case{Topic::Order, "/headerId", 1.5, "F0902", "/headerId: is no whole number"},
      Case{Topic::Order, "/timestamp", "yesterday", "F0903", "/timestamp: 'yesterday' is no time in UTC"},
      Case{Topic::Order, "/timestamp", "2026-02-30T00:00:00Z", "F0903", "/timestamp"},
      Case{Topic::Order, "/version", "2.1", "F0903", "/version: '2.1' is no version"},
      Case{Topic::Order, "/orderId", 5, "F0902", "/orderId: is no text"},
      Case{Topic::Order, "/nodes", json::array(), "F0903", "/nodes: has no items"},
      Case{Topic::Order, "/nodes/1/released", "true", "F0902", "/nodes/1/released: is no true or false"},
      Case{Topic::Order, "/nodes/1/nodePosition/theta", 3.2, "F0903", "/nodes/1/nodePosition/theta"},
      Case{Topic::Order, "/nodes/1/nodePosition/allowedDeviationTheta", -0.1, "F0903",
           "allowedDeviationTheta"},
      Case{Topic::Order, "/nodes/1/nodePosition/mapId", nullptr, "F0902",
           "/nodes/1/nodePosition: lacks 'mapId'"},
      Case{Topic::Order, "/nodes/1/actions/0/blockingType", "HART", "F0903",
           "'HART' is none of NONE, SOFT, HARD"},
      Case{Topic::Order, "/nodes/1/actions/0/actionParameters/0/value", nullptr, "F0902", "lacks 'value'"},
      Case{Topic::Order, "/edges/0/orientationType", "LOCAL", "F0903", "/edges/0/orientationType"},
      Case{Topic::Order, "/edges/0/trajectory/knotVector/2", 1.5, "F0903",
           "/edges/0/trajectory/knotVector/2"},
      Case{Topic::Order, "/edges/0/trajectory/degree", 0, "F0903", "/edges/0/trajectory/degree"},
      Case{Topic::State, "/operatingMode", "AUTOMATISCH", "F0903", "/operatingMode"},
      Case{Topic::State, "/safetyState", nullptr, "F0902", "lacks 'safetyState'"},
      Case{Topic::State, "/safetyState/eStop", "none", "F0903", "/safetyState/eStop"},
      Case{Topic::State, "/actionStates/1/actionStatus", "DONE", "F0903", "/actionStates/1/actionStatus"},
      Case{Topic::State, "/batteryState/batteryHealth", 101, "F0903", "/batteryState/batteryHealth"},
      Case{Topic::State, "/agvPosition/x", "1", "F0902", "/agvPosition/x: is no number"},
      Case{Topic::Connection, "/connectionState", "LOST", "F0903", "/connectionState"},
      Case{Topic::Visualization, "/velocity/omega", json::array(), "F0902", "/velocity/omega"},
      Case{Topic::InstantActions, "/actions/0/actionId", nullptr, "F0902", "/actions/0: lacks 'actionId'"},
      Case{Topic::Factsheet, "/agvGeometry/wheelDefinitions/2/type", "ROUND", "F0903",
           "/agvGeometry/wheelDefinitions/2/type"},
      Case{Topic::Factsheet, "/protocolLimits/maxArrayLens/order.nodes", -5, "F0903",
           "/protocolLimits/maxArrayLens/order.nodes"}};
  for (const Case& broken : cases) expect_named(broken);
}

TEST(CheckMessage, Meaning_WhenOneThingIsWrong_ThenItIsNamedWithItsPlace) {
  const std::vector<Case> cases = {
      Case{Topic::Order, "/nodes/1/sequenceId", 3, "F0904", "/nodes/1/sequenceId: 3 is odd"},
      Case{Topic::Order, "/nodes/2/sequenceId", 6, "F0904", "/nodes/2/sequenceId: 6 does not follow 2"},
      Case{Topic::Order, "/nodes/0/sequenceId", 2, "F0904", "a new order begins with sequenceId 0"},
      Case{Topic::Order, "/edges/1/sequenceId", 4, "F0904", "/edges/1/sequenceId: 4 is even"},
      Case{Topic::Order, "/nodes/2/released", true, "F0904", "/edges/1/released: does not fit its nodes"},
      Case{Topic::Order, "/nodes/0/released", false, "F0904", "/nodes/1/released: the base goes on"},
      Case{Topic::Order, "/edges/1/released", true, "F0904", "/edges/1/released: does not fit its nodes"},
      Case{Topic::Order, "/edges/0/startNodeId", "o1.n2", "F0904", "/edges/0/startNodeId"},
      Case{Topic::Order, "/edges/1/endNodeId", "elsewhere", "F0904", "/edges/1/endNodeId"},
      Case{Topic::Order, "/edges", json::array(), "F0904", "/edges: 0 edges join 3 nodes"},
      Case{Topic::Order, "/nodes/1/actions/0/actionId", "o1.e1.a0", "F0904", "is the id of another action"},
      Case{Topic::Order, "/nodes/1/actions/0/actionParameters", kTwoParameters, "F0904",
           "/nodes/1/actions/0/actionParameters/1/key: 'a' comes twice"},
      Case{Topic::Order, "/edges/0/trajectory/degree", 2, "F0904",
           "/edges/0/trajectory/knotVector: has 5 knots"},
      Case{Topic::Order, "/edges/0/trajectory/knotVector/1", 0.75, "F0904",
           "/edges/0/trajectory/knotVector/2: is less"},
      Case{Topic::State, "/nodeStates/1/sequenceId", 2, "F0904",
           "/nodeStates/1/sequenceId: 2 does not follow 2"},
      Case{Topic::State, "/edgeStates/0/sequenceId", 2, "F0904", "/edgeStates/0/sequenceId: 2 is even"},
      Case{Topic::State, "/lastNodeSequenceId", 1, "F0904", "/lastNodeSequenceId: is odd"},
      Case{Topic::State, "/actionStates/1/actionId", "o1.n2.a0", "F0904", "/actionStates/1/actionId"},
      Case{Topic::State, "/maps", kTwoMaps, "F0904", "/maps/1/mapStatus"}};
  for (const Case& broken : cases) expect_named(broken);
}

TEST(CheckMessage, Order_WhenItHasOneNodeAndNoEdge_ThenSound) {
  json root = json::parse(sample_message(Topic::Order));
  root["nodes"].erase(2);
  root["nodes"].erase(1);
  root["edges"] = json::array();
  EXPECT_EQ(to_string(check_message(Topic::Order, root.dump(), "m")), "");
}

TEST(CheckMessage, Message_WhenItHasMembersThatNobodyKnows_ThenSound) {
  json root = json::parse(sample_message(Topic::State));
  root["vendor"] = {{"anything", nullptr}};
  EXPECT_EQ(to_string(check_message(Topic::State, root.dump(), "m")), "");
}

TEST(CheckMessage, Enumeration_WhenMisspelt_ThenTheHintHasTheWord) {
  json root = json::parse(sample_message(Topic::Connection));
  root["connectionState"] = "ONLNE";
  const auto wrong = check_message(Topic::Connection, root.dump(), "m");
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_EQ(wrong.front().hint, "did you mean 'ONLINE'?");
}

TEST(CheckMessage, Text_WhenItIsNoJson_ThenLineAndColumn) {
  const auto wrong = check_message(Topic::State, "{\n \"headerId\": 1,\n \"timestamp\" 7}", "m");
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_EQ(wrong.front().code, "F0901");
  EXPECT_EQ(wrong.front().where.line, 3u);
  EXPECT_EQ(wrong.front().where.column, 14u);
}

TEST(CheckMessage, Text_WhenItIsHostile_ThenRefused) {
  const std::string deep(100'000, '['), large(5u << 20, ' ');
  for (const auto& [text, message] : {std::pair<std::string, std::string>{deep, "more than 32 levels"},
                                      {large, "more than 4 MiB"},
                                      {R"({"headerId": 1, "headerId": 2})", "'headerId' comes twice"},
                                      {R"({"headerId": 1e999})", "too large"},
                                      {"", "no JSON"},
                                      {"\xff\xfe", "no JSON"},
                                      {"[1]", "is no object"}}) {
    const auto wrong = check_message(Topic::State, text, "m");
    ASSERT_EQ(wrong.size(), 1u) << message;
    EXPECT_THAT(wrong.front().message, HasSubstr(message));
  }
}

TEST(CheckMessage, Faults_WhenThereAreMany_ThenTwentyAreNamed) {
  json root = json::parse(sample_message(Topic::State));
  for (int k = 0; k < 1000; ++k) root["errors"].push_back(k);
  EXPECT_EQ(check_message(Topic::State, root.dump(), "m").size(), 20u);
}

}  // namespace
}  // namespace stepwright::fleet::vda5050

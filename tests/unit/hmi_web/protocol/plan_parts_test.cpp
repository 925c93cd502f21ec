#include "hmi_web/protocol/plan_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

namespace stepwright::protocol {
namespace {

using nlohmann::json;

json fleet_document() {
  return json::parse(R"({
    "phase": "executing",
    "fleet": {
      "epoch_s": 3.5,
      "waits": [{"vehicle": "v2", "for": "v1", "from_ms": 0, "until_ms": 5}],
      "conflicts": [[1, 2]],
      "precedences": [{"first": {"vehicle": "v1", "polygon": 2}, "second": {"vehicle": "v2", "polygon": 8}}],
      "sections": [{"order": ["v1", "v2"], "corners_m": [[[0.12345, 1]]]}],
      "paths": [{"vehicle": "v1", "length_m": 3, "stops": [{"arc_m": 1}],
                 "poses_m_m_deg": [[0, 0, 0], [1, 0.001, 0], [2, 0, 0], [2.5, 0, 0], [2, 0, 0]]}],
      "polygons": [{"vehicle": "v1", "polygons": [
        {"corners_m": [[0, 0], [1, 0], [1, 1]], "earliest_ms": [0, 9], "latest_ms": [1, 2], "stay_ms": [1, null]}]}]
    }})");
}

TEST(PlanParts, WhenTheDocumentIsAnObject_ThenItIsWrapped) {
  const auto parts = plan_parts(R"({"phase":"executing","actions":[]})");

  ASSERT_TRUE(parts.has_value());
  EXPECT_EQ(json::parse(parts->plan),
            json::parse(R"({"type":"plan","document":{"phase":"executing","actions":[]}})"));
  EXPECT_EQ(parts->routes, "");
}

TEST(PlanParts, WhenItIsAFleet_ThenWhatIsLargeGoesApart) {
  const auto parts = plan_parts(fleet_document().dump());

  ASSERT_TRUE(parts.has_value());
  const json plan = json::parse(parts->plan)["document"];
  EXPECT_EQ(
      plan["fleet"],
      json::parse(
          R"({"epoch_s": 3.5, "waits": [{"vehicle": "v2", "for": "v1", "from_ms": 0, "until_ms": 5}]})"));
  const json message = json::parse(parts->routes);
  EXPECT_EQ(message["type"], "routes");
  const json routes = message["routes"];
  EXPECT_EQ(routes["sections"], json::parse(R"([{"order": ["v1", "v2"], "corners_m": [[[0.123, 1]]]}])"));
  EXPECT_EQ(routes["polygons"][0]["polygons"][0],
            json::parse(R"({"corners_m": [[0, 0], [1, 0], [1, 1]], "earliest_ms": [0, 9]})"));
  EXPECT_EQ(routes["paths"][0]["stops"], json::parse(R"([{"arc_m": 1}])"));
}

TEST(PlanParts, WhenAStateChanges_ThenTheRoutesAreTheSame) {
  json later = fleet_document();
  later["fleet"]["vehicles"] = json::parse(R"([{"vehicle": "v1", "state": "waiting"}])");

  EXPECT_EQ(plan_parts(later.dump())->routes, plan_parts(fleet_document().dump())->routes);
  EXPECT_NE(plan_parts(later.dump())->plan, plan_parts(fleet_document().dump())->plan);
}

TEST(PlanParts, WhenAWayTurnsBack_ThenThePlaceWhereItDoesIsKept) {
  const json routes = json::parse(plan_parts(fleet_document().dump())->routes)["routes"];

  EXPECT_EQ(routes["paths"][0]["poses_m_m_deg"], json::parse("[[0, 0, 0.0], [2.5, 0, 0.0], [2, 0, 0.0]]"));
}

TEST(PlanParts, WhenAWayIsALongCircle_ThenFewPosesStayAndNoneIsFarFromIt) {
  constexpr double kRadius_m = 5;
  json document = fleet_document();
  json& poses = document["fleet"]["paths"][0]["poses_m_m_deg"];
  poses = json::array();
  for (int k = 0; k <= 3'000; ++k) {
    const double angle = 2 * std::numbers::pi * k / 3'000;
    poses.push_back({kRadius_m * std::cos(angle), kRadius_m * std::sin(angle), 0});
  }

  const json kept = json::parse(plan_parts(document.dump())->routes)["routes"]["paths"][0]["poses_m_m_deg"];

  EXPECT_LT(kept.size(), 100u);
  for (std::size_t k = 1; k < kept.size(); ++k) {
    const double x = (kept[k][0].get<double>() + kept[k - 1][0].get<double>()) / 2;
    const double y = (kept[k][1].get<double>() + kept[k - 1][1].get<double>()) / 2;
    EXPECT_NEAR(std::hypot(x, y), kRadius_m, 1.1 * kWayTolerance_m);
  }
}

TEST(PlanParts, WhenTheFleetIsNoneOrFullOfHoles_ThenTheRestIsSent) {
  for (const char* fleet :
       {"7", "null", "[]", R"({"paths": 3, "polygons": {"a": 1}, "sections": "x"})",
        R"({"paths": [3, {"poses_m_m_deg": "x"}, {"poses_m_m_deg": [[1], [1, 2, "a"], null]}],
                                "polygons": [4, {"polygons": 5}, {"polygons": [6, {"corners_m": null}]}]})"}) {
    const auto parts = plan_parts(R"({"phase": "executing", "fleet": )" + std::string(fleet) + "}");
    ASSERT_TRUE(parts.has_value()) << fleet;
    EXPECT_EQ(json::parse(parts->plan)["document"]["phase"], "executing") << fleet;
  }
}

TEST(PlanParts, WhenTheTextIsNoObject_ThenThereIsNone) {
  for (const char* text : {"", "[]", "7", "{\"phase\":", "{} {}", "\xff", "null"}) {
    EXPECT_FALSE(plan_parts(text).has_value()) << text;
  }
}

TEST(PlanParts, WhenItIsNestedWithoutEnd_ThenTheDepthIsCut) {
  const std::string deep =
      "{\"phase\":\"x\",\"deep\":" + std::string(200'000, '[') + std::string(200'000, ']') + "}";

  const auto message = plan_parts(deep);

  ASSERT_TRUE(message.has_value());
  EXPECT_LT(message->plan.size(), 200u);
}

}  // namespace
}  // namespace stepwright::protocol

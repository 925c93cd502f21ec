// What an operator's page asks of a fleet: each word, and what has to go with it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/unit/supervisor/fleet/executive/small_hall.h"
#include "tests/unit/supervisor/run/asked.h"

namespace stepwright::fleet {
namespace {

class FleetRequests : public testing::Test {
 protected:
  // The code with which it is refused; empty: it is not.
  std::string code(const std::string& text) { return run::refusal(executive_, text); }

  SmallHall hall_;
  FleetExecutive executive_{hall_.planning(), hall_.controller(), hall_.options(), {}};
};

TEST_F(FleetRequests, WhenTheyCanBeMeant_ThenTheyAreTaken) {
  EXPECT_EQ(code(R"_({"request": "order", "name": "box", "from": "dock B", "to": "shelf 2"})_"), "");
  EXPECT_EQ(code(R"_({"request": "block", "name": "spill", "corners_m": [[1, 1], [3, 1], [3, 2], [1, 2]]})_"),
            "");
  EXPECT_EQ(code(R"_({"request": "unblock", "name": "spill"})_"), "");
  EXPECT_EQ(code(R"_({"request": "return", "vehicle": "truck 2"})_"), "");
  for (const char* word : {"hold", "resume", "abort"})
    EXPECT_EQ(code(std::string(R"_({"request": ")_") + word + "\"}"), "") << word;
}

TEST_F(FleetRequests, WhenTheyCannotBeMeantOrNotNow_ThenTheCodeTells) {
  EXPECT_EQ(code(R"_({"request": "order", "name": "box", "from": "attic", "to": "shelf 2"})_"), "X0003");
  EXPECT_EQ(code(R"_({"request": "return", "vehicle": "truck 9"})_"), "X0003");
  EXPECT_EQ(code(R"_({"request": "start", "goal": "(is-at v1 f1)"})_"), "X0003") << "it has no goals";
  EXPECT_EQ(code(R"_({"request": "start"})_"), "X0008") << "it begins by itself";
}

TEST_F(FleetRequests, WhenAnotherMissionWouldTakeIt_ThenThisOneDoesNot) {
  for (const char* text :
       {R"_({"request": "halt"})_", R"_({"request": "what_if", "goal": "(is-at v1 f1)"})_",
        R"_({"request": "cancel_what_if"})_", R"_({"request": "goal", "goal": "(is-at v1 f1)"})_",
        R"_({"request": "change", "fluent": "(demand c1)", "value": 8})_"})
    EXPECT_EQ(code(text), "X0003") << text;
  const auto form = nlohmann::json::parse(executive_.goal_form());
  EXPECT_EQ(form["available"], false);
  const auto& locations = form["locations"];
  EXPECT_NE(std::ranges::find(locations, "dock B"), locations.end()) << "an order goes between these";
  EXPECT_NE(std::ranges::find(locations, "shelf 2"), locations.end());
  EXPECT_FALSE(executive_.new_outlook().has_value());
}

TEST_F(FleetRequests, WhenSomethingThatBelongsToThemIsMissingOrWrong_ThenTheyAreNone) {
  for (const char* text :
       {R"_({"request": "order", "name": "box", "from": "dock B"})_",
        R"_({"request": "order", "name": "box", "from": "dock B", "to": "shelf 2", "amount": -1})_",
        R"_({"request": "order", "name": "box", "from": "dock B", "to": "shelf 2", "amount": 1e12})_",
        R"_({"request": "block", "name": "spill", "corners_m": [[1, 1], [3, 1]]})_",
        R"_({"request": "block", "name": "shelf 2"})_",
        R"_({"request": "block", "name": "spill", "corners_m": [[1, 1], [3, "x"], [4, 4]]})_",
        R"_({"request": "unblock"})_", R"_({"request": "return", "vehicle": 2})_"})
    EXPECT_EQ(code(text), "X0005") << text;
}

}  // namespace
}  // namespace stepwright::fleet

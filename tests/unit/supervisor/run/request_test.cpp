#include "programs/supervisor/operator_request.h"

#include <gtest/gtest.h>

namespace stepwright::supervisor_program {
namespace {

TEST(OperatorRequest, WhenItAborts_ThenItIsAnAbort) {
  const auto request = parse_operator_request(R"_({"request": "abort"})_");
  ASSERT_TRUE(request.has_value());
  EXPECT_TRUE(std::holds_alternative<AbortRequest>(*request));
}

TEST(OperatorRequest, WhenItHoldsOrResumes_ThenItIsThat) {
  const auto hold = parse_operator_request(R"_({"request": "hold"})_");
  ASSERT_TRUE(hold.has_value());
  EXPECT_TRUE(std::holds_alternative<HoldRequest>(*hold));
  const auto resume = parse_operator_request(R"_({"request": "resume"})_");
  ASSERT_TRUE(resume.has_value());
  EXPECT_TRUE(std::holds_alternative<ResumeRequest>(*resume));
}

TEST(OperatorRequest, WhenItChangesADemand_ThenFluentAndValueAreRead) {
  const auto request =
      parse_operator_request(R"_({"request": "change", "fluent": "(demand c1)", "value": 8.5})_");
  ASSERT_TRUE(request.has_value());
  const auto& change = std::get<ChangeRequest>(*request);
  EXPECT_EQ(change.fluent, "(demand c1)");
  EXPECT_EQ(change.value, 8.5);
}

TEST(OperatorRequest, WhenItWantsAnotherGoal_ThenTheGoalIsRead) {
  const auto request = parse_operator_request(R"_({"request": "goal", "goal": "(= (level a1) 4)"})_");
  ASSERT_TRUE(request.has_value());
  EXPECT_EQ(std::get<GoalRequest>(*request).goal, "(= (level a1) 4)");
}

TEST(OperatorRequest, WhenItStarts_ThenTheGoalMayBeLeftOut) {
  EXPECT_EQ(std::get<StartRequest>(parse_operator_request(R"_({"request": "start"})_").value()).goal, "");
  EXPECT_EQ(std::get<StartRequest>(
                parse_operator_request(R"_({"request": "start", "goal": "(is-at v1 f1)"})_").value())
                .goal,
            "(is-at v1 f1)");
}

TEST(OperatorRequest, WhenItAsksWhatIf_ThenGoalAndIdAreRead) {
  const auto asked =
      parse_operator_request(R"_({"request": "what_if", "id": "7f", "goal": "(is-at v1 f1)"})_");
  EXPECT_EQ(std::get<WhatIfRequest>(asked.value()).id, "7f");
  EXPECT_EQ(std::get<WhatIfRequest>(asked.value()).goal, "(is-at v1 f1)");
  const auto cancelled = parse_operator_request(R"_({"request": "cancel_what_if", "id": "7f"})_");
  EXPECT_EQ(std::get<CancelWhatIfRequest>(cancelled.value()).id, "7f");
}

TEST(OperatorRequest, WhenAFleetIsAsked_ThenEachKindIsRead) {
  const auto read = [](const char* text) {
    return std::get<fleet::FleetChange>(parse_operator_request(text).value());
  };
  const auto order = std::get<fleet::OrderChange>(
      read(R"_({"request": "order", "name": "box", "from": "dock", "to": "rack", "amount": 2})_"));
  EXPECT_EQ(order.name, "box");
  EXPECT_EQ(order.from, "dock");
  EXPECT_EQ(order.to, "rack");
  EXPECT_EQ(order.amount, 2u);
  const auto block = std::get<fleet::BlockChange>(
      read(R"_({"request": "block", "name": "spill", "corners_m": [[1, 1], [3, 1], [3, 2], [1, 2]]})_"));
  EXPECT_NEAR(block.place.area.area_m2(), 2.0, 1e-12);
  const auto free = std::get<fleet::UnblockChange>(read(R"_({"request": "unblock", "name": "spill"})_"));
  EXPECT_EQ(free.name, "spill");
  const auto back = std::get<fleet::ReturnChange>(read(R"_({"request": "return", "vehicle": "truck 2"})_"));
  EXPECT_EQ(back.vehicle, "truck 2");
}

TEST(OperatorRequest, WhenTheTextIsAnythingElse_ThenItIsRefused) {
  for (const char* text :
       {"",
        "{",
        "7",
        "null",
        "[]",
        "{}",
        R"_({"request": 7})_",
        R"_({"request": null})_",
        R"_({"request": ["abort"]})_",
        R"_({"request": "halt"})_",
        R"_({"request": "goal"})_",
        R"_({"request": "goal", "goal": 4})_",
        R"_({"request": "start", "goal": 4})_",
        R"_({"request": "what_if", "goal": ["(is-at v1 f1)"]})_",
        R"_({"request": "what_if", "goal": "(is-at v1 f1)", "id": 7})_",
        R"_({"request": "cancel_what_if", "id": {}})_",
        R"_({"request": "change"})_",
        R"_({"request": "change", "fluent": "(demand c1)"})_",
        R"_({"request": "change", "fluent": 3, "value": 8})_",
        R"_({"request": "change", "fluent": [], "value": 8})_",
        R"_({"request": "change", "fluent": "(demand c1)", "value": "8"})_",
        R"_({"request": "order", "name": "box", "from": "dock"})_",
        R"_({"request": "order", "name": "box", "from": "dock", "to": "rack", "amount": -1})_",
        R"_({"request": "order", "name": "box", "from": "dock", "to": "rack", "amount": 1e12})_",
        R"_({"request": "block", "name": "spill", "corners_m": [[1, 1], [3, 1]]})_",
        R"_({"request": "block", "name": "spill", "corners_m": [[1, 1], [3, "x"], [4, 4]]})_",
        R"_({"request": "unblock"})_",
        R"_({"request": "return", "vehicle": 2})_",
        R"_({"request": "change", "fluent": "(demand c1)", "value": 1e999})_",
        "{\"request\": \"\xff\"}"}) {
    const auto request = parse_operator_request(text);
    ASSERT_FALSE(request.has_value()) << text;
    EXPECT_EQ(request.error()[0].code, "X0005");
  }
}

}  // namespace
}  // namespace stepwright::supervisor_program

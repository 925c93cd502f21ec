#include "plant_models/components/step_answer.h"

#include <gtest/gtest.h>

#include <chrono>

#include "tests/unit/plant_models/components/model_rig.h"

namespace stepwright::components {
namespace {

using namespace std::chrono_literals;

constexpr const char* kFilling = R"toml([components.well]
type = "source"
[components.pump]
type = "pump"
head = "20 m"
resistance = "20000 m/(m3/s)"
in = "well"
out = "vessel"
command = "PUMP"
[components.vessel]
type = "tank"
volume = "100 l"
[terminals]
PUMP = "%QX0.0"
)toml";

double level_after(const AnswerRequest& request) {
  ModelRig rig(kFilling);
  const auto answer = record_answer(rig.plant(), request);
  if (!answer) throw std::runtime_error(result::to_string(answer.error()));
  EXPECT_FALSE(answer->failed);
  EXPECT_DOUBLE_EQ(answer->times_s.back(), request.seconds);
  return answer->columns.at(0).values.back();
}

TEST(StepAnswer, WhenSomethingIsSetBetweenTwoRows_ThenItHoldsFromItsTimeOn) {
  const AnswerAction on{"PUMP", 1.0, 1.0, false};
  const AnswerAction off{"PUMP", 0.0, 13.5, false};
  const double fine = level_after({20.0, 10ms, {"vessel.level"}, {on, off}});
  EXPECT_GT(fine, 10.0);
  EXPECT_NEAR(level_after({20.0, 20s, {"vessel.level"}, {on, off}}), fine, 1e-6);
  EXPECT_NEAR(level_after({20.0, 20s, {"vessel.level"}, {off, on}}), fine, 1e-6);  // in any order
  EXPECT_DOUBLE_EQ(level_after({20.0, 20s, {"vessel.level"}, {{"PUMP", 1.0, 20.0, false}}}), 0.0);
}

TEST(StepAnswer, WhenWhatComesAfterTheEndIsWrong_ThenItIsToldAllTheSame) {
  ModelRig rig(kFilling);
  const auto answer = record_answer(rig.plant(), {1.0, 10ms, {}, {{"PUMPE", 1.0, 1e300, false}}});
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().front().code, "C0301");
  EXPECT_EQ(answer.error().front().hint, "did you mean 'PUMP'?");
}

TEST(StepAnswer, WhenTheIntervalDoesNotDivideTheTime_ThenTheLastRowIsTheEnd) {
  for (const std::chrono::nanoseconds interval : {7s, 100s}) {
    ModelRig rig(kFilling);
    const auto answer = record_answer(rig.plant(), {20.0, interval, {}, {}});
    ASSERT_TRUE(answer);
    EXPECT_DOUBLE_EQ(answer->times_s.back(), 20.0);
    EXPECT_EQ(answer->times_s.size(), interval == 7s ? 4u : 2u);
  }
}

TEST(StepAnswer, WhenAValueIsMinusZero_ThenTheTableHasZero) {
  ModelRig rig(R"toml([types.mirror]
parameters.tick = { unit = "s", default = "1 s" }
states.x = { start = "0", derivative = "1 / tick" }
outputs.back = { value = "-x" }
outputs.far = { switch = true, value = "x > 5" }
[components.m]
type = "mirror"
[terminals]
FAR = { address = "%IX0.0", from = "m.far" }
)toml");
  const auto answer = record_answer(rig.plant(), {1.0, 1s, {"m.back"}, {}});
  ASSERT_TRUE(answer) << result::to_string(answer.error());
  EXPECT_EQ(to_csv(*answer).rfind("time_s,m.back\n0,0\n1,-", 0), 0u) << to_csv(*answer);
}

std::string refusal_of(const AnswerAction& action) {
  ModelRig rig(kFilling);
  const auto answer = record_answer(rig.plant(), {50.0, 10s, {}, {action}});
  if (answer) return "taken";
  return answer.error().front().code + ": " + answer.error().front().message + "; " +
         answer.error().front().hint;
}

TEST(StepAnswer, WhenATerminalCannotHaveTheValue_ThenItIsRefused) {
  EXPECT_EQ(refusal_of({"PUMP", 1.0, 5.0, false}), "taken");
  EXPECT_EQ(refusal_of({"PUMP", 2.5, 5.0, false}),
            "C0350: terminal 'PUMP' cannot be 2.5; a switch is 0 or 1");
  EXPECT_EQ(refusal_of({"PUMP", -1.0, 5.0, false}).substr(0, 5), "C0350");
}

TEST(StepAnswer, WhenSomethingIsSetAfterTheEnd_ThenItIsRefused) {
  EXPECT_EQ(refusal_of({"PUMP", 1.0, 50.0, false}), "taken");
  EXPECT_EQ(refusal_of({"PUMP", 1.0, 100.0, false}),
            "C0350: 'PUMP' is set at 100 s, and the run ends at 50 s; --seconds says how long it runs");
  EXPECT_EQ(refusal_of({"pump.blocked", 1.0, 100.0, true}).substr(0, 5), "C0350");
}

}  // namespace
}  // namespace stepwright::components

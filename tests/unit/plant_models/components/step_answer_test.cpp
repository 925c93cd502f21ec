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

}  // namespace
}  // namespace stepwright::components

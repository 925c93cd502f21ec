#include "supervisor/translate/progress.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "supervisor/translate/translation.h"
#include "tests/unit/supervisor/translate/bench_run.h"

namespace stepwright::translate {
namespace {

class ProgressTest : public ::testing::Test {
 protected:
  Progress with(const std::vector<std::string>& steps) const {
    std::vector<bool> active(translation_.steps.size(), false);
    for (const std::string& name : steps) active.at(translation_.step(name).value()) = true;
    return progress(translation_, active);
  }

  // The name of an action's step of a kind.
  std::string step_of(std::size_t action, StepKind kind) const {
    for (const StepInfo& step : translation_.steps)
      if (step.action == action && step.kind == kind) return step.name;
    return "none";
  }

  Translation translation_ =
      *translate(testing::bench_run(testing::metric_ff_plan()), testing::bench_binding());
};

TEST_F(ProgressTest, WhenOnlyTheRestOfAnActionRuns_ThenItHasDoneWhatItWasFor) {
  const Progress now = with({step_of(0, StepKind::Rest)});
  EXPECT_EQ(now.actions[0], ActionState::Active);
  EXPECT_TRUE(now.rests(0));
  EXPECT_FALSE(now.done()[0]);
  EXPECT_TRUE(now.completed()[0]);
  EXPECT_FALSE(now.completed()[1]);
}

TEST_F(ProgressTest, WhenAnActionRunsOrHasFailed_ThenItIsNotCompleted) {
  for (const StepKind kind : {StepKind::Action, StepKind::Failed}) {
    const Progress now = with({step_of(0, kind)});
    EXPECT_FALSE(now.rests(0));
    EXPECT_FALSE(now.completed()[0]);
  }
}

TEST_F(ProgressTest, WhenNoRestIsKnown_ThenNothingRests) {
  Progress old;
  old.actions = {ActionState::Active};
  EXPECT_FALSE(old.rests(0));
}

}  // namespace
}  // namespace stepwright::translate

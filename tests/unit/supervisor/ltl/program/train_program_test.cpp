#include "supervisor/ltl/program/train_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "ladder/driver/compile.h"
#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/planner/plan_train.h"
#include "tests/unit/supervisor/ltl/program/small_hall.h"

namespace stepwright::ltl {
namespace {

class TrainProgramTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto answer = plan_train(problem_, {.most_s = 600.0});
    ASSERT_TRUE(answer) << to_string(answer.error());
    plan_ = with_run_out(problem_, answer->plan);
    way_ = train_way(problem_, plan_, {});
    const auto formula = parse_formula(problem_.task, "task", problem_.places());
    ASSERT_TRUE(formula);
    const auto monitor = monitor_automaton(*formula);
    ASSERT_TRUE(monitor);
    watch_ = train_watch(monitor->automaton, problem_.task);
  }

  TrainProgramInput input(TrainProgramKind kind) const {
    return {.kind = kind,
            .train = &problem_.train,
            .places = problem_.places(),
            .way = kind == TrainProgramKind::Observe ? nullptr : &way_,
            .watch = &watch_};
  }

  Problem problem_ = testing::small_hall(2, "visit press then visit rack, press before wash");
  TrainTerminals terminals_ = train_terminals_in_a_row(2, 3);
  TrainPlan plan_;
  TrainWay way_;
  TrainWatch watch_;
};

TEST_F(TrainProgramTest, WhenAProgramIsMade_ThenItCompilesWhateverItIsFor) {
  for (const TrainProgramKind kind :
       {TrainProgramKind::Drive, TrainProgramKind::Halt, TrainProgramKind::Observe}) {
    const auto program = train_program(input(kind), terminals_);
    ASSERT_TRUE(program) << to_string(program.error());
    driver::CompileInput sources;
    sources.texts.push_back({"monitor.st", program->monitor});
    sources.projects.push_back(&program->project);
    const auto output = driver::compile(sources);
    EXPECT_TRUE(output) << to_string(output.error());
  }
}

TEST_F(TrainProgramTest, WhenAPlanIsDriven_ThenTheStepsAreTheStatesThatItGoesThrough) {
  const auto program = train_program(input(TrainProgramKind::Drive), terminals_);
  ASSERT_TRUE(program);
  std::uint32_t state = watch_.automaton.initial;
  double arc_m = 0.0;
  std::size_t driving = 0;
  for (const TrainStep& step : program->steps) {
    if (step.kind != TrainStepKind::Drive) continue;
    ++driving;
    EXPECT_EQ(step.state, state) << step.name;
    EXPECT_GE(step.arc_m, arc_m);
    state = watch_.automaton.next(state, step.label);
    arc_m = step.arc_m;
  }
  EXPECT_EQ(driving, 2u) << "the press, then the rack";
  const auto arrive = std::ranges::find(program->steps, TrainStepKind::Arrive, &TrainStep::kind);
  ASSERT_NE(arrive, program->steps.end());
  EXPECT_EQ(arrive->state, state);
  EXPECT_TRUE(watch_.automaton.accepting(state));
}

TEST_F(TrainProgramTest, WhenATaskIsHalfDone_ThenTheChartBeginsThere) {
  TrainWatch later = watch_;
  later.automaton.initial = later.automaton.next(later.automaton.initial, 1);  // the press
  TrainProgramInput half = input(TrainProgramKind::Drive);
  half.watch = &later;
  const auto program = train_program(half, terminals_);
  ASSERT_TRUE(program);
  EXPECT_EQ(std::ranges::count(program->steps, TrainStepKind::Drive, &TrainStep::kind), 1);
  EXPECT_EQ(later.key, watch_.key) << "an online change carries the monitor by its name";
}

TEST_F(TrainProgramTest, WhenATerminalIsMissingOrTheWayIsFarAway_ThenThatIsSaid) {
  const auto code = [&](const TrainTerminals& terminals) {
    const auto program = train_program(input(TrainProgramKind::Drive), terminals);
    return program ? std::string() : program.error().front().code;
  };
  TrainTerminals terminals = terminals_;
  terminals.speed.clear();
  EXPECT_EQ(code(terminals), "L0501");
  terminals = terminals_;
  terminals.hitches.pop_back();
  EXPECT_EQ(code(terminals), "L0501");
  terminals = terminals_;
  terminals.at.pop_back();
  EXPECT_EQ(code(terminals), "L0501");
  way_.samples[3].pose.x_m = 400.0;
  EXPECT_EQ(code(terminals_), "L0502");
}

TEST(TrainTerminals, WhenTheyStandInARow_ThenWordsComeFirst) {
  const TrainTerminals terminals = train_terminals_in_a_row(3, 10);
  EXPECT_EQ(terminals.x, "%IW0");
  EXPECT_EQ(terminals.hitches.back(), "%IW7");
  EXPECT_EQ(terminals.trailers, "%IW8");
  EXPECT_EQ(terminals.way_free, "%IX18.2");
  EXPECT_EQ(terminals.at.front(), "%IX19.0");
  EXPECT_EQ(terminals.at.back(), "%IX20.1");
  EXPECT_EQ(terminals.enable, "%QX4.0");
}

}  // namespace
}  // namespace stepwright::ltl

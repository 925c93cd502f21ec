// Plans with one step wrong: the validator judges each as the naive interpreter does, step by step.

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <random>

#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/support/pddl/naive/feature_task.h"
#include "tests/support/pddl/naive/interpreter.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using testing::Interpreter;
using testing::NaiveAction;
using testing::NaiveState;
using testing::TaskText;
using Actions = std::vector<NaiveAction>;

struct Judged {
  bool valid = false;
  std::size_t failed_step = 0;  // from 1
  std::optional<double> cost;   // of a plan whose steps can all be executed
};

// The plan from the place where it differs from the good one, whose states are known.
Judged judge(const Interpreter& pddl, const std::vector<NaiveState>& good, const Actions& plan,
             std::size_t same) {
  NaiveState state = good[same];
  for (std::size_t i = same; i < plan.size(); ++i) {
    auto next = pddl.apply(state, plan[i]);
    if (!next) return {false, i + 1, std::nullopt};
    state = std::move(*next);
  }
  Judged judged{pddl.goal(state), 0, pddl.metric(state)};
  judged.valid = judged.valid && judged.cost.has_value();
  return judged;
}

struct Totals {
  std::size_t plans = 0, valid = 0, failing = 0, missing = 0;  // missing: the goal
};

class Mutants {
 public:
  Mutants(const TaskText& text, std::uint32_t seed)
      : task_(testing::make_task(text.domain, text.problem)),
        pddl_(text.domain, text.problem),
        all_(pddl_.actions()),
        random_(seed) {
    for (const Object& object : task_.definition().objects) objects_.push_back(object.name);
  }

  // False if there is no plan with steps.
  bool run(Totals& totals) {
    Options options;
    options.first_only = true;
    options.budget.time = std::chrono::milliseconds(300);
    const model::Outcome outcome = solve(task_, options);
    if (!outcome.plan || outcome.plan->actions.empty()) return false;
    for (const model::GroundAction& action : outcome.plan->actions) {
      plan_.push_back({action.name, action.arguments});
    }
    states_.push_back(pddl_.initial());
    for (const NaiveAction& action : plan_) {
      auto next = pddl_.apply(states_.back(), action);
      if (!next) {
        ADD_FAILURE() << "the interpreter refuses the plan found";
        return true;
      }
      states_.push_back(std::move(*next));
    }
    compare(plan_, plan_.size(), totals);
    for (std::size_t i = 0; i < plan_.size() && !::testing::Test::HasFailure(); ++i) mutate(i, totals);
    return true;
  }

 private:
  void mutate(std::size_t i, Totals& totals) {
    Actions dropped = plan_;
    dropped.erase(dropped.begin() + static_cast<std::ptrdiff_t>(i));
    compare(dropped, i, totals);
    Actions doubled = plan_;
    doubled.insert(doubled.begin() + static_cast<std::ptrdiff_t>(i), plan_[i]);
    compare(doubled, i + 1, totals);
    for (std::size_t j = i + 1; j < plan_.size(); ++j) {
      Actions swapped = plan_;
      std::swap(swapped[i], swapped[j]);
      compare(swapped, i, totals);
    }
    constexpr int kReplacements = 12;
    for (int k = 0; k < kReplacements; ++k) {
      Actions replaced = plan_;
      replaced[i] = all_[random_() % all_.size()];
      compare(replaced, i, totals);
    }
    for (std::size_t a = 0; a < plan_[i].arguments.size(); ++a) {
      for (const std::string& object : objects_) {
        Actions replaced = plan_;
        replaced[i].arguments[a] = object;
        compare(replaced, i, totals);
      }
    }
    Actions shortened = plan_;
    if (!shortened[i].arguments.empty()) {
      shortened[i].arguments.pop_back();
      compare(shortened, i, totals);
    }
  }

  void compare(const Actions& plan, std::size_t same, Totals& totals) {
    PlanText text;
    for (const NaiveAction& action : plan) text.actions.push_back({action.name, action.arguments});
    text.lines.assign(plan.size(), 0);
    const Validation validation = validate(task_, text);
    const Judged judged = judge(pddl_, states_, plan, same);
    ++totals.plans;
    EXPECT_EQ(validation.valid, judged.valid) << result::to_string(validation.diagnostics);
    EXPECT_EQ(validation.failed_step, judged.failed_step) << result::to_string(validation.diagnostics);
    if (judged.valid && task_.definition().metric) {
      EXPECT_NEAR(validation.cost(), *judged.cost, 1e-8);
    }
    EXPECT_EQ(validation.diagnostics.empty(), judged.valid);
    if (judged.valid) ++totals.valid;
    if (judged.failed_step != 0) ++totals.failing;
    if (judged.failed_step == 0 && !judged.valid) ++totals.missing;
    if (!::testing::Test::HasFailure()) return;
    for (const model::GroundAction& action : text.actions) ADD_FAILURE() << model::to_string(action);
  }

  Task task_;
  Interpreter pddl_;
  Actions all_;
  std::vector<std::string> objects_;
  std::mt19937 random_;
  Actions plan_;
  std::vector<NaiveState> states_;  // before every step, and after the last
};

class MutatedPlans : public ::testing::TestWithParam<std::uint32_t> {};

// Eight seeds with 25 plans each: 200 plans.
TEST_P(MutatedPlans, WhenOneStepIsWrong_ThenTheValidatorJudgesAsTheInterpreter) {
  Totals totals;
  int plans = 0;
  for (std::uint32_t i = 0; plans < 25 && i < 2000 && !HasFailure(); ++i) {
    const TaskText text = testing::feature_task(GetParam() * 10000 + i);
    SCOPED_TRACE(text.domain + text.problem);
    if (Mutants(text, i).run(totals)) ++plans;
  }
  EXPECT_EQ(plans, 25);
  EXPECT_GT(totals.valid, 100u);
  EXPECT_GT(totals.failing, 300u);
  EXPECT_GT(totals.missing, 20u);
  std::cout << totals.plans << " plans: " << totals.valid << " valid, " << totals.failing
            << " fail at a step, " << totals.missing << " miss the goal\n";
}

INSTANTIATE_TEST_SUITE_P(Seeds, MutatedPlans, ::testing::Range(1u, 9u));

TaskText bench_text(const std::string& suffix) {
  const auto domain = read_source(testing::bench_file("domain" + suffix + ".pddl"));
  const auto problem = read_source(testing::bench_file("problem" + suffix + ".pddl"));
  return {domain->text, problem->text};
}

TEST(MutatedPlans, WhenTheBenchPlanHasAWrongStep_ThenTheValidatorJudgesAsTheInterpreter) {
  for (const std::string suffix : {"", "_load"}) {
    Totals totals;
    EXPECT_TRUE(Mutants(bench_text(suffix), 1).run(totals));
    EXPECT_GT(totals.valid, 3u);
    EXPECT_GT(totals.failing, 100u);
    EXPECT_GT(totals.missing, 3u);
  }
}

}  // namespace
}  // namespace stepwright::pddl

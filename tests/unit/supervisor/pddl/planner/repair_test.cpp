#include "supervisor/pddl/planner/repair.h"

#include <gtest/gtest.h>

#include <random>

#include "supervisor/pddl/plan/validate.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

using testing::bench_task;

Options optimal() {
  Options options;
  options.optimal = true;
  return options;
}

std::vector<model::GroundAction> from(const model::Plan& plan, std::size_t first) {
  return {plan.actions.begin() + static_cast<std::ptrdiff_t>(first), plan.actions.end()};
}

Validation validated(const Task& task, const model::Plan& plan) {
  PlanText text;
  text.actions = plan.actions;
  text.lines.assign(text.actions.size(), 0);
  return validate(task, text);
}

void expect_suffix(const RepairOutcome& mended, const std::vector<model::GroundAction>& remaining) {
  const auto& actions = mended.outcome.plan->actions;
  ASSERT_GE(actions.size(), mended.kept);
  EXPECT_EQ(mended.connection + mended.kept, actions.size());
  EXPECT_TRUE(std::equal(actions.end() - static_cast<std::ptrdiff_t>(mended.kept), actions.end(),
                         remaining.end() - static_cast<std::ptrdiff_t>(mended.kept)));
}

class RepairBench : public ::testing::Test {
 protected:
  RepairBench() : plan_(*solve(task_, optimal()).plan), trace_(*simulate(task_, plan_)) {}

  Task task_ = bench_task();
  model::Plan plan_;
  Trace trace_;
};

TEST_F(RepairBench, WhenNothingIsWrong_ThenThePlanIsKeptWithoutAnySearch) {
  for (std::size_t done = 0; done < plan_.actions.size(); ++done) {
    const Task now = *task_.with_initial(trace_.states[done]);
    const RepairOutcome mended = repair(now, from(plan_, done), {.search = optimal()});
    EXPECT_EQ(mended.kind, RepairKind::Kept) << done;
    EXPECT_EQ(mended.kept, plan_.actions.size() - done);
    EXPECT_EQ(mended.outcome.plan->actions, from(plan_, done));
    EXPECT_TRUE(mended.outcome.plan->orderings.has_value());
    EXPECT_EQ(mended.outcome.expanded, 0u);
    EXPECT_EQ(mended.replan_ms, 0.0);
  }
}

// The vehicle was carried to another place by hand: one trip back, then the plan as it was.
TEST_F(RepairBench, WhenTheVehicleStandsElsewhere_ThenOneMoveConnectsTheWholeRest) {
  State state = trace_.states[1];
  ASSERT_TRUE(state.holds("(is-at v1 f1)"));
  state.set("(is-at v1 f1)", false);
  state.set("(is-at v1 a2)", true);
  const RepairOutcome mended =
      repair(*task_.with_initial(state), from(plan_, 1),
             {.search = optimal(), .connect_time = std::chrono::minutes(1), .compare = false});
  ASSERT_EQ(mended.kind, RepairKind::Repaired);
  EXPECT_GE(mended.kept, plan_.actions.size() - 2);
  EXPECT_LE(mended.connection, 1u);
  expect_suffix(mended, from(plan_, 1));
}

TEST_F(RepairBench, WhenAnActionIsDoneAlready_ThenItIsLeftOut) {
  const Task now = *task_.with_initial(trace_.states[3]);
  const RepairOutcome mended = repair(now, plan_.actions, {.search = optimal()});
  EXPECT_NE(mended.kind, RepairKind::None);
  EXPECT_TRUE(validated(now, *mended.outcome.plan).valid);
  EXPECT_EQ(mended.outcome.plan->cost, trace_.cost.back());
}

TEST_F(RepairBench, WhenTheRepairIsWorse_ThenTheNewPlanIsTaken) {
  // The old plan goes to and fro for nothing; from its middle a new plan need not.
  std::vector<model::GroundAction> detour = {{"move", {"v1", "f1", "a1"}}, {"move", {"v1", "a1", "f1"}}};
  State state = trace_.states[0];
  state.set("(is-at v1 f1)", false);
  state.set("(is-at v1 a2)", true);
  std::vector<model::GroundAction> remaining = detour;
  remaining.insert(remaining.end(), detour.begin(), detour.end());
  remaining.insert(remaining.end(), plan_.actions.begin(), plan_.actions.end());
  const Task now = *task_.with_initial(state);
  const RepairOutcome mended = repair(now, remaining, {.search = optimal()});
  ASSERT_TRUE(mended.outcome.plan.has_value());
  ASSERT_TRUE(mended.replanned_cost.has_value());
  EXPECT_EQ(mended.outcome.plan->cost, *mended.replanned_cost);
  EXPECT_LT(mended.kept, remaining.size());
}

TEST_F(RepairBench, WhenCancelled_ThenNoPlanIsPromised) {
  std::atomic<bool> cancel{true};
  State state = trace_.states[0];
  state.assign("(level a1)", 4);
  RepairOptions options;
  options.search.cancel = &cancel;
  const RepairOutcome mended = repair(*task_.with_initial(state), plan_.actions, options);
  EXPECT_EQ(mended.kind, RepairKind::None);
  EXPECT_EQ(mended.outcome.kind, model::OutcomeKind::Cancelled);
}

TEST_F(RepairBench, WhenTheRestNamesAnUnknownAction_ThenItIsReplanned) {
  const RepairOutcome mended = repair(task_, {{"fly", {"v1"}}}, {.search = optimal()});
  EXPECT_EQ(mended.kind, RepairKind::Replanned);
  EXPECT_EQ(mended.outcome.plan->cost, plan_.cost);
}

TEST_F(RepairBench, WhenNoPlanExists_ThenTheReasonIsThatOfThePlanner) {
  const Task now = *task_.with_goal("(>= (level a1) 11)");
  const RepairOutcome mended = repair(now, plan_.actions, {.search = optimal()});
  EXPECT_EQ(mended.kind, RepairKind::None);
  EXPECT_EQ(mended.outcome.kind, model::OutcomeKind::Infeasible);
  EXPECT_FALSE(mended.outcome.reason.empty());
}

// A connection that needs a search is looked for only while that may be quicker than the new plan was, or
// where there is none.
TEST_F(RepairBench, WhenNoTimeIsLeftForConnections_ThenNoneIsSearched) {
  State state = trace_.states[1];
  state.assign("(level a1)", 3);
  Options first;
  first.first_only = true;  // without proof
  const Task now = *task_.with_initial(state);
  const RepairOutcome mended = repair(now, from(plan_, 1), {.search = first, .connect_time = {}});
  ASSERT_TRUE(mended.outcome.plan);
  EXPECT_EQ(mended.searches, 0u);
  EXPECT_GT(repair(now, from(plan_, 1), {.search = optimal(), .compare = false}).searches, 0u);
}

// What is left of a plan may be kept behind the last of its actions that is excluded, and a new plan has
// none.
TEST_F(RepairBench, WhenActionsAreExcluded_ThenOnlyWhatIsBehindThemIsKept) {
  const Task task = testing::counter_task("(= (n) 7)");
  const std::vector<model::GroundAction> remaining = {{"three", {}}, {"three", {}}, {"one", {}}};
  Options search = optimal();
  search.excluded = [](const model::GroundAction& action) { return action.name == "three"; };
  for (const bool compare : {true, false}) {
    const RepairOutcome mended = repair(
        task, remaining, {.search = search, .connect_time = std::chrono::minutes(1), .compare = compare});
    ASSERT_EQ(mended.kind, RepairKind::Repaired);
    EXPECT_EQ(mended.outcome.plan->actions, std::vector<model::GroundAction>(7, {"one", {}}));
    EXPECT_EQ(mended.kept, 1u);
  }
  search.excluded = [](const model::GroundAction& action) { return action.name == "one"; };
  for (const bool compare : {true, false}) {
    const RepairOutcome mended = repair(task, remaining, {.search = search, .compare = compare});
    EXPECT_EQ(mended.kind, RepairKind::None);
    EXPECT_EQ(mended.outcome.kind, model::OutcomeKind::Infeasible);
  }
}

// Levels, places and demands at random, at random places of the plan.
TEST_F(RepairBench, WhenAnythingIsDisturbed_ThenThePlanValidatesAndCostsNoMoreThanANewOne) {
  std::mt19937 random(7);
  const auto pick = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  int repaired = 0;
  for (int i = 0; i < 120; ++i) {
    const auto done = static_cast<std::size_t>(pick(0, static_cast<int>(plan_.actions.size()) - 1));
    State state = trace_.states[done];
    const auto disturb = [&](const char* fluent, int by) {
      state.assign(fluent, std::clamp(*state.value(fluent) + by, 0.0, 10.0));
    };
    if (pick(0, 1) == 0) disturb("(level a1)", pick(-3, 2));
    if (pick(0, 1) == 0) disturb("(lev v1)", pick(-2, 2));
    if (pick(0, 3) == 0) disturb("(demand c2)", pick(-2, 2));
    if (pick(0, 3) == 0) {
      for (const char* place : {"(is-at v1 f1)", "(is-at v1 a1)", "(is-at v1 a2)"}) state.set(place, false);
      state.set(pick(0, 1) == 0 ? "(is-at v1 a1)" : "(is-at v1 f1)", true);
    }
    const Task now = *task_.with_initial(state);
    const RepairOutcome mended = repair(now, from(plan_, done), {.search = optimal()});
    if (mended.kind == RepairKind::None) {
      EXPECT_EQ(solve(now, optimal()).kind, model::OutcomeKind::Infeasible) << i;
      continue;
    }
    ASSERT_TRUE(mended.outcome.plan.has_value()) << i;
    const Validation validation = validated(now, *mended.outcome.plan);
    EXPECT_TRUE(validation.valid) << i << ": " << result::to_string(validation.diagnostics);
    EXPECT_EQ(validation.cost(), mended.outcome.plan->cost);
    if (mended.replanned_cost) {
      EXPECT_LE(mended.outcome.plan->cost, *mended.replanned_cost) << i;
    }
    // So a repair takes some executions of a plan, and never the time of a second search.
    ASSERT_TRUE(mended.outcome.plan->proved_optimal || mended.kind == RepairKind::Kept) << i;
    EXPECT_EQ(mended.searches, 0u) << i;
    if (mended.kind != RepairKind::Replanned) expect_suffix(mended, from(plan_, done));
    repaired += mended.kind == RepairKind::Repaired ? 1 : 0;
  }
  EXPECT_GT(repaired, 20);
}

// Facts (p o), (q) and numbers (x), (y) between 0 and 9, with conditional effects and comparisons of both.
class RandomTask {
 public:
  explicit RandomTask(std::uint32_t seed) : random_(seed) {}

  std::string domain() {
    std::string text = R"((define (domain d) (:requirements :adl :numeric-fluents) (:types thing)
      (:predicates (p ?o - thing) (q)) (:functions (x) (y) (cost))
)";
    for (int i = 0; i < 5; ++i) text += action(i);
    return text + ")";
  }

  std::string problem() {
    return "(define (problem r) (:domain d) (:objects a b - thing) (:init (= (x) " + number() + ") (= (y) " +
           number() + ") (= (cost) 0)" + (pick(2) ? " (p a)" : "") + ") (:goal (and (p b) " + comparison() +
           " " + fact("a") + ")) (:metric minimize (cost)))";
  }

  State disturbed(State state) {
    state.assign(pick(2) ? "(x)" : "(y)", pick(10));
    if (pick(2)) state.set("(p b)", pick(2) != 0);
    if (pick(3) == 0) state.set("(q)", pick(2) != 0);
    return state;
  }

  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }

 private:
  std::string number() { return std::to_string(pick(6)); }

  std::string comparison() {
    static const char* relations[] = {"<=", "=", ">=", ">"};
    const std::string right = pick(2) ? number() : "(+ (y) " + number() + ")";
    return std::string("(") + relations[pick(4)] + " (x) " + right + ")";
  }

  std::string fact(const std::string& object) {
    switch (pick(4)) {
      case 0:
        return "(not (p " + object + "))";
      case 1:
        return "(or (q) (p " + object + "))";
      case 2:
        return "(imply (q) " + comparison() + ")";
      default:
        return "(p " + object + ")";
    }
  }

  std::string action(int index) {
    const std::string fluent = pick(2) ? "(x)" : "(y)";
    const std::string amount = std::to_string(1 + pick(3));
    const bool up = pick(3) != 0;
    std::string condition = up ? "(<= " + fluent + " 6)" : "(>= " + fluent + " " + amount + ")";
    if (pick(2)) condition += " " + fact("?o");
    std::string effect = "(" + std::string(up ? "increase " : "decrease ") + fluent + " " + amount + ")";
    if (pick(3) == 0) effect = "(when (q) " + effect + ")";
    if (pick(3) == 0) effect = "(assign " + fluent + " " + (pick(2) ? "(x)" : number()) + ")";
    effect += pick(3) == 0 ? " (not (p ?o))" : " (p ?o)";
    if (pick(3) == 0) effect += pick(2) ? " (q)" : " (not (q))";
    if (pick(3) == 0) effect += " (when " + comparison() + " (not (p ?u)))";
    effect += " (increase (cost) " + number() + ")";
    return "(:action a" + std::to_string(index) + " :parameters (?o ?u - thing) :precondition (and " +
           condition + ") :effect (and " + effect + "))\n";
  }

  std::mt19937 random_;
};

class RepairRandom : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RepairRandom, WhenDisturbed_ThenTheRepairedPlanValidates) {
  int solved = 0;
  int connected = 0;
  for (std::uint32_t i = 0; i < 30; ++i) {
    RandomTask random(GetParam() * 1000 + i);
    const std::string domain = random.domain();
    const std::string problem = random.problem();
    SCOPED_TRACE(domain + problem);
    const Task task = testing::make_task(domain, problem);
    const Options search = optimal();
    const model::Outcome first = solve(task, search);
    if (!first.plan || first.plan->actions.empty()) continue;
    const auto trace = simulate(task, *first.plan);
    const auto done = static_cast<std::size_t>(random.pick(static_cast<int>(first.plan->actions.size())));
    const Task now = *task.with_initial(random.disturbed(trace->states[done]));
    for (const bool compare : {true, false}) {
      const RepairOutcome mended =
          repair(now, from(*first.plan, done), {.search = search, .compare = compare});
      if (mended.kind == RepairKind::None) {
        EXPECT_EQ(solve(now, search).kind, model::OutcomeKind::Infeasible);
        continue;
      }
      ++solved;
      connected += mended.kind == RepairKind::Repaired ? 1 : 0;
      const Validation validation = validated(now, *mended.outcome.plan);
      EXPECT_TRUE(validation.valid) << result::to_string(validation.diagnostics);
      EXPECT_EQ(validation.cost(), mended.outcome.plan->cost);
    }
  }
  EXPECT_GT(solved, 8);
  EXPECT_GT(connected, 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RepairRandom, ::testing::Range(1u, 9u));

}  // namespace
}  // namespace stepwright::pddl

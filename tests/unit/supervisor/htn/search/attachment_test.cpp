// The experiments of Karlsson et al. 2012 on the level of tasks, with a stand-in for geometry; refusals and
// the way back.

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "supervisor/htn/plan/validate.h"
#include "supervisor/htn/search/search.h"
#include "supervisor/htn/task/read_task.h"
#include "tests/support/htn/table_geometry.h"

namespace stepwright::htn::test {
namespace {

using model::OutcomeKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

lisp::Source file(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(STEPWRIGHT_SOURCE_DIR "/tests/cells/htn/" + name + ".hddl").rdbuf();
  return {name + ".hddl", text.str()};
}

const TableLimits kBothSides = {
    {{"left", {"table", "red-region", "gray-region"}}, {"right", {"table", "green-region", "gray-region"}}},
    {}};
const TableLimits kRightSide = {
    {{"left", {"gray-region", "red-region"}}, {"right", {"table", "green-region", "gray-region"}}}, {}};
const TableLimits kBox = {{{"left", {"box-top", "red-region"}}, {"right", {"table", "box-top"}}}, {}};

TableLimits tray(int room) {
  return {{{"left", {}}, {"right", {"table", "tray"}}}, {{"tray", room}}};
}

struct Solved {
  SearchOutcome outcome;
  SearchStatistics statistics;
  std::vector<std::string> steps;
};

Solved solve(const std::string& problem_name, const TableLimits& limits) {
  const lisp::Source domain = file("two_arms"), problem = file(problem_name);
  const auto read = read_task(domain, problem, kGeometricPredicates);
  Solved solved;
  if (!read) {
    ADD_FAILURE() << result::to_string(read.error());
    return solved;
  }
  EXPECT_THAT(read->warnings, IsEmpty()) << result::to_string(read->warnings);
  TableGeometry geometry(read->task, limits);
  {
    Search search(read->task, {}, &geometry);
    solved.outcome = search.next();
    solved.statistics = search.statistics();
    if (solved.outcome.plan) {
      const Plan& plan = *solved.outcome.plan;
      const Validation judged =
          validate(domain, problem, plan, {kGeometricPredicates.begin(), kGeometricPredicates.end()});
      EXPECT_TRUE(judged.valid) << judged.reason;
      EXPECT_EQ(geometry.depth(), plan.steps.size());
      for (const std::size_t step : plan.steps) solved.steps.push_back(to_string(plan.nodes[step]));
    }
  }
  EXPECT_EQ(geometry.depth(), 0u);  // the search takes back what it told
  return solved;
}

TEST(TwoArms, WhenTwoCupsGoToTheLeft_ThenThePlanIsThePapers) {
  EXPECT_THAT(solve("d1", kBothSides).steps,
              ElementsAre("(pick left top cup2)", "(place left red-region cup2)", "(pick left top cup1)",
                          "(place left red-region cup1)"));
}

TEST(TwoArms, WhenACupGoesFromHandToHand_ThenThePlanIsThePapers) {
  EXPECT_THAT(solve("d2", kRightSide).steps,
              ElementsAre("(pick right top cup2)", "(place right green-region cup2)", "(pick right top cup1)",
                          "(place right gray-region cup1)", "(move-hand-away right cup1)",
                          "(pick left top cup1)", "(place left red-region cup1)"));
}

TEST(TwoArms, WhenABoxIsInTheWay_ThenItsTopIsUsed) {
  const Solved solved = solve("p1", kBox);
  EXPECT_THAT(solved.steps, ElementsAre("(pick right top cup1)", "(place right box-top cup1)",
                                        "(move-hand-away right cup1)", "(pick left top cup1)",
                                        "(place left red-region cup1)"));
  EXPECT_GT(solved.statistics.refusals, 0u);
}

TEST(TwoArms, WhenCansFitOnATray_ThenTheyGoThereOneByOne) {
  EXPECT_EQ(solve("p2", tray(2)).steps.size(), 4u);
  EXPECT_THAT(solve("p3", tray(3)).steps,
              ElementsAre("(pick right top can1)", "(place right tray can1)", "(pick right top can2)",
                          "(place right tray can2)", "(pick right top can3)", "(place right tray can3)"));
  EXPECT_EQ(solve("p4", tray(4)).steps.size(), 8u);
  EXPECT_EQ(solve("p5", tray(4)).steps.size(), 4u);
  EXPECT_EQ(solve("p6", tray(4)).steps.size(), 6u);
}

TEST(TwoArms, WhenATrayIsTooSmall_ThenThatIsProvedAndTold) {
  const Solved solved = solve("p4", tray(3));
  EXPECT_EQ(solved.outcome.kind, OutcomeKind::Infeasible);
  EXPECT_THAT(solved.outcome.reason, HasSubstr("no room in tray"));
}

std::string without(std::string text, const std::string& part) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.erase(at, part.size());
}

TEST(Bar, WhenFiveDrinksAreAskedFor_ThenShotsAreSparedForMixing) {
  const lisp::Source domain = file("bar"), problem = file("evening");
  const auto read = read_task(domain, problem);
  ASSERT_TRUE(read) << result::to_string(read.error());
  Search search(read->task);
  const SearchOutcome outcome = search.next();
  ASSERT_TRUE(outcome.plan);
  const Validation judged = validate(domain, problem, *outcome.plan);
  EXPECT_TRUE(judged.valid) << judged.reason;
  EXPECT_EQ(outcome.plan->steps.size(), 59u);
  EXPECT_EQ(outcome.plan->cost, 16.0);
  EXPECT_LT(search.statistics().decompositions, 40u);
}

TEST(Bar, WhenThereAreTooFewShots_ThenThatIsProved) {
  const lisp::Source domain = file("bar");
  lisp::Source problem = file("evening");
  for (const char* part : {" s5 s6", "(on-table s5) (on-table s6)", "(empty s5) (empty s6)"})
    problem.text = without(problem.text, part);
  const auto read = read_task(domain, problem);
  ASSERT_TRUE(read) << result::to_string(read.error());
  Search search(read->task);
  EXPECT_EQ(search.next().kind, OutcomeKind::Infeasible);
  EXPECT_GT(search.statistics().known_nodes, 100u);
}

// Four decisions one after the other; the last action asks.
constexpr const char* kDecisions = R"((define (domain d)
  (:predicates (chosen ?a ?x) (fits))
  (:task decide :parameters (?a))
  (:method choose :parameters (?a ?x) :task (decide ?a) :precondition () :ordered-subtasks (and (set ?a ?x)))
  (:action set :parameters (?a ?x) :precondition () :effect (chosen ?a ?x))
  (:action close :parameters () :precondition (fits) :effect ())))";
constexpr const char* kDecisionsProblem = R"((define (problem p) (:domain d) (:objects a b c x y)
  (:htn :ordered-subtasks (and (decide a) (decide b) (decide c) (close))) (:init)))";

// Refuses until the first action sets `a` to `y`.
class FirstDecision : public SemanticAttachment {
 public:
  FirstDecision(const PlanningTask& task, bool proven) : task_(task), proven_(proven) {}
  void push(const ExternalCall& action) override {
    prefix_.emplace_back(action.objects.begin(), action.objects.end());
  }
  void pop() override { prefix_.pop_back(); }
  std::optional<Refusal> require(const ExternalCall&, bool) override {
    ++asked;
    if (generous || task_.objects[static_cast<std::size_t>(prefix_[0][1])].name == "y") return std::nullopt;
    return Refusal{0, proven_, "wrong from the beginning"};
  }
  std::optional<Refusal> change(const ExternalCall&, bool) override { return std::nullopt; }
  std::optional<Fingerprint> fingerprint() const override {
    Fingerprint print;
    for (const auto& action : prefix_)
      for (const int object : action) print = followed_by(print, static_cast<std::uint64_t>(object));
    return print;
  }

  int asked = 0;
  bool generous = false;

 private:
  const PlanningTask& task_;
  bool proven_;
  std::vector<std::vector<int>> prefix_;
};

TEST(HtnAttachment, WhenTheCauseIsEarly_ThenTheSearchGoesThereAtOnce) {
  const auto read = read_task({"d", kDecisions}, {"p", kDecisionsProblem}, {"fits"});
  ASSERT_TRUE(read) << result::to_string(read.error());
  FirstDecision judge(read->task, true);
  Search search(read->task, {}, &judge);
  const SearchOutcome outcome = search.next();
  ASSERT_TRUE(outcome.plan);
  EXPECT_EQ(to_string(outcome.plan->nodes[outcome.plan->steps[0]]), "(set a y)");
  EXPECT_EQ(judge.asked, 5);  // a, b, c and x would be 4 * 125 without a way back
  EXPECT_EQ(search.statistics().backjumps, 4u);
}

TEST(HtnAttachment, WhenNothingWasProved_ThenTheSearchCanBeginAnew) {
  const std::string problem = std::string(kDecisionsProblem);
  const auto read =
      read_task({"d", kDecisions}, {"p", std::string(problem).erase(problem.find(" y)"), 2)}, {"fits"});
  ASSERT_TRUE(read) << result::to_string(read.error());
  FirstDecision judge(read->task, false);
  Search search(read->task, {}, &judge);
  const SearchOutcome first = search.next();
  EXPECT_EQ(first.kind, OutcomeKind::Exhausted);
  EXPECT_THAT(first.reason, HasSubstr("without proof"));
  judge.generous = true;
  search.retry_unproven();
  EXPECT_EQ(search.next().kind, OutcomeKind::Solved);
}

TEST(HtnAttachment, WhenAPlanIsRejected_ThenItsBeginningDoesNotComeAgain) {
  const auto read = read_task({"d", kDecisions}, {"p", kDecisionsProblem}, {"fits"});
  ASSERT_TRUE(read) << result::to_string(read.error());
  FirstDecision judge(read->task, true);
  judge.generous = true;
  Search search(read->task, {}, &judge);
  ASSERT_TRUE(search.next().plan);
  search.reject(1, true);  // its first two actions
  const SearchOutcome other = search.next();
  ASSERT_TRUE(other.plan);
  EXPECT_EQ(to_string(other.plan->nodes[other.plan->steps[0]]), "(set a a)");
  EXPECT_EQ(to_string(other.plan->nodes[other.plan->steps[1]]), "(set b b)");
}

}  // namespace
}  // namespace stepwright::htn::test

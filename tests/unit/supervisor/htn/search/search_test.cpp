#include "supervisor/htn/search/search.h"

#include <gmock/gmock.h>

#include <atomic>

#include "supervisor/htn/plan/validate.h"
#include "supervisor/htn/task/read_task.h"
#include "tests/support/htn/transport.h"

namespace stepwright::htn {
namespace {

using model::OutcomeKind;
using testing::ElementsAre;
using testing::HasSubstr;

// Texts, the task that they say, and what its search answers.
class HtnSearch : public testing::Test {
 protected:
  void read(const std::string& domain, const std::string& problem) {
    read_texts("(define (domain d) " + domain + ")", "(define (problem p) (:domain d) " + problem + ")");
  }

  void read_texts(const std::string& domain, const std::string& problem) {
    domain_ = {"domain.hddl", domain};
    problem_ = {"problem.hddl", problem};
    auto result = read_task(domain_, problem_);
    ASSERT_TRUE(result) << result::to_string(result.error());
    task_ = std::move(result->task);
  }

  std::vector<std::string> steps(const SearchOutcome& outcome) {
    std::vector<std::string> texts;
    if (!outcome.plan) return {to_string(outcome.kind) + ": " + outcome.reason};
    const Validation judged = validate(domain_, problem_, *outcome.plan);
    EXPECT_TRUE(judged.valid) << judged.reason;
    for (const std::size_t step : outcome.plan->steps)
      texts.push_back(htn::to_string(outcome.plan->nodes[step]));
    return texts;
  }

  std::vector<std::string> plan(SearchOptions options = {}) {
    Search search(task_, options);
    return steps(search.next());
  }

  static std::string to_string(OutcomeKind kind) {
    return kind == OutcomeKind::Infeasible  ? "infeasible"
           : kind == OutcomeKind::Exhausted ? "exhausted"
           : kind == OutcomeKind::Cancelled ? "cancelled"
                                            : "solved";
  }

  lisp::Source domain_, problem_;
  PlanningTask task_;
};

constexpr const char* kChoice = R"(
  (:predicates (p ?x) (q ?x) (r ?x))
  (:task t :parameters ())
  (:method first :parameters (?x) :task (t) :precondition (p ?x) :ordered-subtasks (and (a ?x)))
  (:method second :parameters (?x) :task (t) :precondition (q ?x) :ordered-subtasks (and (b ?x)))
  (:action a :parameters (?x) :precondition () :effect (r ?x))
  (:action b :parameters (?x) :precondition () :effect (r ?x)))";

TEST_F(HtnSearch, WhenThereAreChoices_ThenMethodsAndObjectsAreTriedInTheirOrder) {
  read(kChoice, "(:objects x y) (:htn :ordered-subtasks (and (t))) (:init (p y) (q x) (p x) (q y))");
  Search search(task_);
  EXPECT_THAT(steps(search.next()), ElementsAre("(a x)"));
  EXPECT_THAT(steps(search.next()), ElementsAre("(a y)"));
  EXPECT_THAT(steps(search.next()), ElementsAre("(b x)"));
  EXPECT_THAT(steps(search.next()), ElementsAre("(b y)"));
  EXPECT_EQ(search.next().kind, OutcomeKind::Infeasible);
  EXPECT_EQ(search.next().kind, OutcomeKind::Infeasible);
}

TEST_F(HtnSearch, WhenThereIsAGoal_ThenOnlyWhatReachesItIsAPlan) {
  read(kChoice, "(:objects x y) (:htn :ordered-subtasks (and (t))) (:init (p x) (p y)) (:goal (r y))");
  EXPECT_THAT(plan(), ElementsAre("(a y)"));
}

TEST_F(HtnSearch, WhenNothingWorks_ThenTheFarthestTryIsTold) {
  read(kChoice, "(:objects x y) (:htn :ordered-subtasks (and (t) (t))) (:init) (:goal (r y))");
  EXPECT_THAT(plan(), ElementsAre(HasSubstr("(t) has no further way: no method can be applied")));
  read(R"((:predicates (p) (q)) (:action a :parameters () :precondition (p) :effect (and (not (p)) (q)))
          (:action b :parameters () :precondition (and (q) (p)) :effect ()))",
       "(:htn :ordered-subtasks (and (a) (b))) (:init (p))");
  EXPECT_THAT(plan(),
              ElementsAre(HasSubstr("after 1 action(s), ends where (b) cannot be done: (p) does not hold")));
}

TEST_F(HtnSearch, WhenATaskLeadsBackToItself_ThenTheLoopIsLeft) {
  read(R"((:predicates (p)) (:task t :parameters ())
          (:method round :parameters () :task (t) :precondition () :ordered-subtasks (and (t)))
          (:method turn :parameters () :task (t) :precondition () :ordered-subtasks (and (on) (off) (t)))
          (:action on :parameters () :precondition (not (p)) :effect (p))
          (:action off :parameters () :precondition (p) :effect (not (p))))",
       "(:htn :ordered-subtasks (and (t))) (:init)");
  EXPECT_THAT(plan(), ElementsAre(HasSubstr("infeasible: every decomposition was tried")));
}

// a^n b^n: the network has to grow.
constexpr const char* kGrowing = R"(
  (:predicates (next ?a ?b) (at ?a) (back ?a))
  (:task t :parameters ())
  (:method more :parameters (?a ?b) :task (t) :precondition (and (at ?a) (next ?a ?b))
    :ordered-subtasks (and (up ?a ?b) (t) (down ?b)))
  (:method enough :parameters () :task (t) :precondition () :ordered-subtasks ())
  (:action up :parameters (?a ?b) :precondition (at ?a) :effect (and (not (at ?a)) (at ?b)))
  (:action down :parameters (?b) :precondition () :effect (back ?b)))";

TEST_F(HtnSearch, WhenNetworksHaveToGrow_ThenStagesFindThePlan) {
  std::string objects, facts = "(at n0)";
  for (int i = 0; i <= 30; ++i) objects += " n" + std::to_string(i);
  for (int i = 0; i < 30; ++i) facts += " (next n" + std::to_string(i) + " n" + std::to_string(i + 1) + ")";
  read(kGrowing, "(:objects" + objects + ") (:htn :ordered-subtasks (and (t))) (:init " + facts +
                     ") (:goal (and (back n20) (at n20)))");
  Search search(task_);
  EXPECT_EQ(steps(search.next()).size(), 40u);
  EXPECT_GT(search.statistics().stages, 1u);
  EXPECT_EQ(search.next().kind, OutcomeKind::Infeasible);  // every number of turns ends elsewhere
}

TEST_F(HtnSearch, WhenRecursionNeverEnds_ThenTheBoundIsTold) {
  read(R"((:predicates (p)) (:task t :parameters ())
          (:method more :parameters () :task (t) :precondition () :ordered-subtasks (and (t) (a)))
          (:action a :parameters () :precondition (p) :effect (not (p))))",
       "(:htn :ordered-subtasks (and (t))) (:init)");
  SearchOptions options;
  options.most_pending = 50;
  EXPECT_THAT(plan(options), ElementsAre(HasSubstr("exhausted: no network of up to 50 tasks")));
}

TEST_F(HtnSearch, WhenLanguageFeaturesAreUsed_ThenTheyMeanWhatTheySay) {
  read(R"((:requirements :typing)
          (:types box - thing lamp)
          (:predicates (full ?b - box) (lit ?l - lamp) (done))
          (:task all :parameters ())
          (:method m :parameters () :task (all)
            :precondition (exists (?b - box) (and (full ?b) (imply (lit l1) (not (full ?b)))))
            :ordered-subtasks (and (switch l1) (finish)))
          (:action switch :parameters (?l - lamp) :precondition (or (lit ?l) (not (lit ?l)))
            :effect (and (when (lit ?l) (not (lit ?l))) (when (not (lit ?l)) (lit ?l))
                         (forall (?b - box) (when (not (full ?b)) (full ?b)))))
          (:action finish :parameters () :precondition (and (lit l1) (forall (?b - box) (full ?b)))
            :effect (and (done) (not (done)))))",
       "(:objects b1 b2 b3 - box l1 - lamp) (:htn :ordered-subtasks (and (all))) (:init (full b2)) (:goal "
       "(done))");
  EXPECT_EQ(task_.predicates.size(), 3u);
  EXPECT_THAT(plan(), ElementsAre("(switch l1)", "(finish)"));
}

TEST_F(HtnSearch, WhenActionsCost_ThenTheSumIsThePlans) {
  read(R"((:predicates (p)) (:functions (total-cost) (far ?a)) 
          (:action go :parameters (?a) :precondition () :effect (and (p) (increase (total-cost) (far ?a)) (increase (total-cost) 1))))",
       "(:objects x y) (:htn :parameters (?a) :ordered-subtasks (and (go ?a) (go ?a))) (:init (= (far y) 3) "
       "(= (total-cost) 0))");
  Search search(task_);
  const SearchOutcome outcome = search.next();
  EXPECT_THAT(steps(outcome), ElementsAre("(go y)", "(go y)"));  // x has no distance
  EXPECT_EQ(outcome.plan->cost, 8.0);
}

TEST_F(HtnSearch, WhenCancelledOrLate_ThenItEndsAndCanGoOn) {
  read(kChoice, "(:objects x y) (:htn :ordered-subtasks (and (t))) (:init (p y))");
  std::atomic<bool> cancel{true};
  SearchOptions cancelled;
  cancelled.cancel = &cancel;
  EXPECT_THAT(plan(cancelled), ElementsAre(HasSubstr("cancelled")));
  SearchOptions late;
  late.until = std::chrono::steady_clock::now() - std::chrono::seconds(1);
  Search search(task_, late);
  EXPECT_EQ(search.next().kind, OutcomeKind::Exhausted);
  search.extend(std::nullopt);
  EXPECT_THAT(steps(search.next()), ElementsAre("(a y)"));
}

TEST_F(HtnSearch, WhenPlansAreLong_ThenTheWorkGrowsWithThem) {
  read_texts(test::transport_domain(), test::ring_problem(50, 40));
  Search search(task_);
  const SearchOutcome outcome = search.next();
  const std::size_t steps_of_it = steps(outcome).size();
  EXPECT_GT(steps_of_it, 1000u);
  EXPECT_LT(search.statistics().decompositions, 3 * steps_of_it);
}

TEST_F(HtnSearch, WhenAPlaceCannotBeReached_ThenThatIsProved) {
  std::string problem = test::grid_problem(6, 3);
  const std::string last = "(deliver k2 l11)";
  ASSERT_NE(problem.find(last), std::string::npos);
  problem.replace(problem.find(last), last.size(), "(deliver k2 island)");
  problem.replace(problem.find("l0 - place"), 10, "island l0 - place");
  read_texts(test::transport_domain(), problem);
  EXPECT_THAT(plan(), ElementsAre(HasSubstr("infeasible")));
}

TEST_F(HtnSearch, WhenAskedAgain_ThenPlansAndFiguresAreTheSame) {
  read_texts(test::transport_domain(), test::grid_problem(6, 5));
  Search one(task_), two(task_);
  EXPECT_EQ(print_plan(*one.next().plan), print_plan(*two.next().plan));
  EXPECT_EQ(one.statistics().decompositions, two.statistics().decompositions);
}

}  // namespace
}  // namespace stepwright::htn

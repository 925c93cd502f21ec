#include "supervisor/pddl/search/engines/width_search.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/control/plan_runner.h"
#include "supervisor/pddl/search/engines/lazy_search.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

struct Result {
  SearchStatus status = SearchStatus::Running;
  double cost = kInfinity;  // of the plan, executed
  std::uint64_t expanded = 0;
};

Result search(const Task& task, std::uint64_t states, bool by_width) {
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  arrange_by_groups(ground);
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  StopReason reason = StopReason::None;
  Result result;
  WidthSearch width(relaxed, control, landmarks);
  LazyOptions options;
  options.landmarks = &landmarks;
  LazySearch lazy(relaxed, control, options);
  // In small pieces: it must go on where it stopped.
  for (std::uint64_t done = 0; done < states && result.status == SearchStatus::Running; done += 7) {
    result.status = by_width ? width.run(7, reason) : lazy.run(7, reason);
  }
  result.expanded = control.expanded();
  if (control.best().quality.found()) result.cost = cost_of_plan(space, control.best().operators);
  return result;
}

// A pile that is to stand elsewhere in another order, with hoists that hold one crate each: relaxed plans do
// not see that crates stand in each other's way.
Task depot() {
  return testing::make_task(
      R"((define (domain depot) (:requirements :typing)
    (:types site thing truck hoist - object crate pallet - thing)
    (:predicates (parked ?t - truck ?s - site) (mounted ?h - hoist ?s - site) (located ?x - thing ?s - site)
                 (on ?c - crate ?x - thing) (clear ?x - thing) (holds ?h - hoist ?c - crate) (idle ?h - hoist)
                 (loaded ?c - crate ?t - truck))
    (:action drive :parameters (?t - truck ?from ?to - site) :precondition (parked ?t ?from)
      :effect (and (not (parked ?t ?from)) (parked ?t ?to)))
    (:action lift :parameters (?h - hoist ?c - crate ?x - thing ?s - site)
      :precondition (and (mounted ?h ?s) (idle ?h) (located ?c ?s) (on ?c ?x) (clear ?c))
      :effect (and (not (idle ?h)) (holds ?h ?c) (not (located ?c ?s)) (not (on ?c ?x)) (not (clear ?c)) (clear ?x)))
    (:action drop :parameters (?h - hoist ?c - crate ?x - thing ?s - site)
      :precondition (and (mounted ?h ?s) (holds ?h ?c) (located ?x ?s) (clear ?x))
      :effect (and (idle ?h) (not (holds ?h ?c)) (located ?c ?s) (on ?c ?x) (clear ?c) (not (clear ?x))))
    (:action put-in :parameters (?h - hoist ?c - crate ?t - truck ?s - site)
      :precondition (and (mounted ?h ?s) (parked ?t ?s) (holds ?h ?c))
      :effect (and (not (holds ?h ?c)) (idle ?h) (loaded ?c ?t)))
    (:action take-out :parameters (?h - hoist ?c - crate ?t - truck ?s - site)
      :precondition (and (mounted ?h ?s) (parked ?t ?s) (idle ?h) (loaded ?c ?t))
      :effect (and (not (loaded ?c ?t)) (not (idle ?h)) (holds ?h ?c)))))",
      R"((define (problem pile) (:domain depot)
    (:objects s1 s2 s3 - site p1 p2 p3 - pallet c1 c2 c3 c4 - crate h1 h2 h3 - hoist t1 t2 - truck)
    (:init (mounted h1 s1) (idle h1) (mounted h2 s2) (idle h2) (mounted h3 s3) (idle h3) (parked t1 s3) (parked t2 s1)
           (located p1 s1) (located c1 s1) (on c1 p1) (located c3 s1) (on c3 c1) (located c2 s1) (on c2 c3)
           (located c4 s1) (on c4 c2) (clear c4) (located p2 s2) (clear p2) (located p3 s3) (clear p3))
    (:goal (and (on c1 p2) (on c4 c1) (on c3 c4) (on c2 c3)))))");
}

TEST(WidthSearch, WhenCratesStandInEachOthersWay_ThenItFindsAPlanThatEstimatesMiss) {
  constexpr std::uint64_t kStates = 1000;
  const Result width = search(depot(), kStates, true);
  EXPECT_EQ(width.status, SearchStatus::Found);
  EXPECT_LT(width.cost, kInfinity);
  EXPECT_LT(width.expanded, 500u);
  const Result estimates = search(depot(), width.expanded, false);
  EXPECT_NE(estimates.status, SearchStatus::Found);
}

// A robot that walks along a row of free cells, each step nearer to its end.
Task row_of_cells(int cells) {
  std::string names, facts;
  for (int i = 0; i < cells; ++i) {
    const std::string name = "c" + std::to_string(i);
    names += " " + name;
    if (i > 0) facts += "(free " + name + ") (next c" + std::to_string(i - 1) + " " + name + ") ";
  }
  return testing::make_task(
      R"((define (domain d) (:requirements :strips) (:predicates (at ?c) (free ?c) (next ?a ?b))
    (:action step :parameters (?a ?b) :precondition (and (at ?a) (next ?a ?b) (free ?b))
      :effect (and (not (at ?a)) (free ?a) (at ?b) (not (free ?b))))))",
      "(define (problem p) (:domain d) (:objects" + names + ") (:init (at c0) " + facts + ") (:goal (at c" +
          std::to_string(cells - 1) + ")))");
}

TEST(WidthSearch, WhenMostFactsHoldFromTheStart_ThenTheirPairsAreNotLookedUp) {
  constexpr int kCells = 200;
  const Task task = row_of_cells(kCells);
  GroundTask ground = ground_task(task.definition(), [] { return false; });
  arrange_by_groups(ground);
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  StopReason reason = StopReason::None;
  WidthSearch width(relaxed, control, landmarks);
  EXPECT_EQ(width.run(10'000, reason), SearchStatus::Found);
  // A state has about kCells values and three that the start had not; there are kCells states.
  EXPECT_LT(width.looked_up(), 8u * kCells * kCells);
}

TEST(WidthSearch, WhenTasksAreRandom_ThenItFindsAPlanOrProvesThatThereIsNone) {
  int found = 0, none = 0;
  for (std::uint32_t seed = 700; seed < 760; ++seed) {
    const testing::RandomTask random = testing::random_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    const Result width = search(random.task, 5000, true);
    const Result lazy = search(random.task, 5000, false);
    if (width.status == SearchStatus::Running || lazy.status == SearchStatus::Running) continue;
    EXPECT_EQ(width.status, lazy.status);
    EXPECT_EQ(width.status == SearchStatus::Found, width.cost < kInfinity);
    ++(width.status == SearchStatus::Found ? found : none);
  }
  EXPECT_GT(found, 10);
  EXPECT_GT(none, 0);
}

TEST(WidthSearch, WhenNumbersHaveNoEnd_ThenItFindsAPlan) {
  const Result result = search(testing::counter_task("(= (n) 17)"), 5000, true);
  EXPECT_EQ(result.status, SearchStatus::Found);
}

TEST(WidthSearch, WhenTheControlSaysStop_ThenItStops) {
  const Task task = depot();
  const GroundTask ground = ground_task(task.definition(), [] { return false; });
  const StateSpace space(ground);
  const RelaxedTask relaxed(space);
  const Landmarks landmarks(relaxed, [] { return false; });
  SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
  control.finish();
  StopReason reason = StopReason::None;
  EXPECT_EQ(WidthSearch(relaxed, control, landmarks).run(100, reason), SearchStatus::Stopped);
  EXPECT_EQ(reason, StopReason::Finished);
}

}  // namespace
}  // namespace stepwright::pddl

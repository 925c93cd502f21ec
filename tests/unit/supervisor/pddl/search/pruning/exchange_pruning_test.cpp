// What searches leave out because objects can change places: far fewer states, and no plan is lost by that.

#include "supervisor/pddl/search/pruning/exchange_pruning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/search/engines/lazy_search.h"
#include "supervisor/pddl/search/engines/width_search.h"
#include "supervisor/pddl/search/space/finite_domains.h"
#include "tests/support/pddl/exhaustive.h"
#include "tests/support/pddl/random_task.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl {
namespace {

constexpr SetLimits kLimits{.operators = 10'000, .facts = 10'000, .checks = 100'000};

// Divers take tanks of air from a store, in a fixed order, swim with one tank from place to place, and one of
// them is to reach the end. Each dives once.
Task cave(int tanks, int divers) {
  std::string objects, init;
  for (int t = 1; t <= tanks; ++t) {
    objects += " t" + std::to_string(t);
    init += " (behind t" + std::to_string(t) + " t" + std::to_string(t + 1) + ")";
  }
  objects += " t" + std::to_string(tanks + 1) + " - tank";
  for (int d = 1; d <= divers; ++d) {
    objects += " d" + std::to_string(d);
    init += " (dry d" + std::to_string(d) + ")";
  }
  return testing::make_task(
      R"((define (domain cave) (:requirements :typing :negative-preconditions) (:types tank diver place)
  (:predicates (front ?t - tank) (behind ?s ?t - tank) (dry ?d - diver) (at ?d - diver ?p - place)
               (has ?d - diver ?t - tank) (lies ?t - tank ?p - place) (full ?t - tank)
               (next ?p ?q - place) (mouth ?p - place) (busy) (seen ?p - place))
  (:action dive :parameters (?d - diver ?p - place) :precondition (and (dry ?d) (mouth ?p) (not (busy)))
    :effect (and (not (dry ?d)) (at ?d ?p) (busy)))
  (:action leave :parameters (?d - diver ?p - place) :precondition (and (at ?d ?p) (mouth ?p))
    :effect (and (not (at ?d ?p)) (not (busy))))
  (:action fetch :parameters (?d - diver ?s ?t - tank ?p - place)
    :precondition (and (at ?d ?p) (mouth ?p) (front ?s) (behind ?s ?t))
    :effect (and (not (front ?s)) (front ?t) (has ?d ?s) (full ?s)))
  (:action take :parameters (?d - diver ?t - tank ?p - place) :precondition (and (at ?d ?p) (lies ?t ?p))
    :effect (and (not (lies ?t ?p)) (has ?d ?t)))
  (:action lay :parameters (?d - diver ?t - tank ?p - place) :precondition (and (at ?d ?p) (has ?d ?t))
    :effect (and (not (has ?d ?t)) (lies ?t ?p)))
  (:action swim :parameters (?d - diver ?t - tank ?p ?q - place)
    :precondition (and (at ?d ?p) (has ?d ?t) (full ?t) (next ?p ?q))
    :effect (and (not (at ?d ?p)) (not (full ?t)) (at ?d ?q)))
  (:action look :parameters (?d - diver ?p - place) :precondition (at ?d ?p) :effect (seen ?p))))",
      "(define (problem p) (:domain cave) (:objects a b c d - place" + objects +
          " - diver) (:init (front t1) (mouth a) (next a b) (next b a) (next b c) (next c b) (next c d) "
          "(next d c)" +
          init + ") (:goal (and (seen d) (not (busy)))))");
}

// The task must outlive it.
class Searched {
 public:
  explicit Searched(const Task& task)
      : ground_(prepared(task)), space_(ground_), relaxed_(space_), objects_(space_, kLimits) {}

  const StateSpace& space() const { return space_; }
  const Interchangeable& objects() const { return objects_; }

  // Whether there is a plan, by each search with and without pruning; how many states were looked at.
  struct Result {
    SearchStatus status = SearchStatus::Running;
    std::uint64_t expanded = 0;
  };
  Result lazy(bool prune) const {
    LazyOptions options;
    options.lookahead = false;
    if (prune) options.objects = &objects_;
    return run([&](SearchControl& control) { return LazySearch(relaxed_, control, options); });
  }
  Result width(bool prune) const {
    SearchControl asked(std::chrono::milliseconds(0), 0, nullptr);
    const Landmarks landmarks = find_landmarks(relaxed_, asked);
    return run([&](SearchControl& control) {
      return WidthSearch(relaxed_, control, landmarks, prune ? &objects_ : nullptr);
    });
  }

 private:
  static GroundTask prepared(const Task& task) {
    GroundTask ground = ground_task(task.definition(), [] { return false; });
    arrange_by_groups(ground);
    return ground;
  }
  template <typename Make>
  static Result run(const Make& make) {
    SearchControl control(std::chrono::milliseconds(0), 0, nullptr);
    StopReason reason = StopReason::None;
    auto search = make(control);
    const SearchStatus status = search.run(1'000'000, reason);
    return {status, control.expanded()};
  }

  GroundTask ground_;
  StateSpace space_;
  RelaxedTask relaxed_;
  Interchangeable objects_;
};

// Six tanks would take a diver to the last place and back: all states have to be looked at, of three divers.
TEST(ExchangePruning, WhenThereIsNoPlan_ThenThatIsProvedInAFractionOfTheStates) {
  const Task task = cave(3, 3);
  const Searched searched(task);
  for (const bool width : {false, true}) {
    const auto all = width ? searched.width(false) : searched.lazy(false);
    const auto some = width ? searched.width(true) : searched.lazy(true);
    EXPECT_EQ(all.status, SearchStatus::Exhausted);
    EXPECT_EQ(some.status, SearchStatus::Exhausted);
    EXPECT_LT(4 * some.expanded, all.expanded) << width;
  }
}

TEST(ExchangePruning, WhenThereIsAPlan_ThenItIsFound) {
  const Task task = cave(7, 2);
  const Searched searched(task);
  EXPECT_EQ(searched.lazy(true).status, SearchStatus::Found);
  EXPECT_EQ(searched.width(true).status, SearchStatus::Found);
}

TEST(ExchangePruning, WhenTasksAreRandom_ThenAPlanIsFoundWhereThereIsOne) {
  int pruned = 0, none = 0;
  for (std::uint32_t seed = 0; seed < 120; ++seed) {
    const testing::RandomTask random =
        seed % 2 == 0 ? testing::random_task(seed) : testing::random_transport_task(seed);
    SCOPED_TRACE(random.domain + random.problem);
    const GroundTask ground = ground_task(random.task.definition(), [] { return false; });
    if (ground.unreachable_goal) continue;
    const Searched searched(random.task);
    if (searched.objects().none()) continue;
    ++pruned;
    const bool solvable = testing::exhaustive_optimum(random.task, 20'000).has_value();
    none += solvable ? 0 : 1;
    EXPECT_EQ(searched.lazy(true).status, solvable ? SearchStatus::Found : SearchStatus::Exhausted);
    EXPECT_EQ(searched.width(true).status, solvable ? SearchStatus::Found : SearchStatus::Exhausted);
  }
  EXPECT_GT(pruned, 10);
  EXPECT_GT(none, 0);
}

// Which tank is fetched next is fixed; which of those that were fetched is taken is not.
TEST(ExchangePruning, WhenTanksAreOutOfTheStore_ThenTheyAreTwinsAndBeforeTheyAreNot) {
  const Task task = cave(7, 1);
  const Searched searched(task);
  const StateSpace& space = searched.space();
  const auto named = [&](int object) {
    return space.task().definition->objects[static_cast<std::size_t>(object)].name;
  };
  const auto apply = [&](std::vector<Word>& state, const std::string& action) {
    std::vector<int> operators;
    space.applicable(state.data(), operators);
    for (const int op : operators) {
      if (model::to_string(action_of(space.task(), space.task().operators[static_cast<std::size_t>(op)])) !=
          action)
        continue;
      std::vector<Word> next(space.words());
      double cost = 0.0;
      ASSERT_TRUE(space.apply(op, state.data(), next.data(), cost));
      state = next;
      return;
    }
    FAIL() << action;
  };
  std::vector<Word> state = space.initial();
  std::vector<Twin> twins;
  const auto twins_now = [&] {
    searched.objects().find_twins(state.data(), twins);
    std::string text;
    for (const Twin& twin : twins) text += named(twin.object) + "=" + named(twin.first) + " ";
    return text;
  };
  apply(state, "(dive d1 a)");
  EXPECT_EQ(twins_now(), "");
  apply(state, "(fetch d1 t1 t2 a)");
  EXPECT_EQ(twins_now(), "") << "t2 can still be fetched";
  apply(state, "(fetch d1 t2 t3 a)");
  EXPECT_EQ(twins_now(), "t2=t1 ");
  apply(state, "(fetch d1 t3 t4 a)");
  EXPECT_EQ(twins_now(), "t2=t1 t3=t1 ");
  std::vector<Word> one = state, other = state;
  apply(one, "(lay d1 t1 a)");
  apply(other, "(lay d1 t3 a)");
  ASSERT_NE(one, other);
  ExchangePruning pruning(space, searched.objects());
  EXPECT_TRUE(pruning.meet(one.data()));
  EXPECT_FALSE(pruning.meet(other.data()));
  std::vector<int> operators;
  space.applicable(state.data(), operators);
  const std::size_t all = operators.size();
  pruning.look_at(state.data());
  pruning.leave_out(operators);
  EXPECT_EQ(all - operators.size(), 4u) << "to swim with t2 or t3, or to lay them down";
}

}  // namespace
}  // namespace stepwright::pddl

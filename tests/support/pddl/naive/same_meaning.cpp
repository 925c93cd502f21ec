#include "tests/support/pddl/naive/same_meaning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <set>

#include "supervisor/pddl/grounding/grounder.h"
#include "supervisor/pddl/lifted/executor.h"
#include "supervisor/pddl/search/space/state_space.h"
#include "tests/support/pddl/naive/interpreter.h"
#include "tests/support/pddl/sample_tasks.h"

namespace stepwright::pddl::testing {
namespace {

NaiveState named(const Definition& definition, const LiftedState& state) {
  NaiveState named;
  for (const Atom& fact : state.facts) named.facts.insert(fact_name(definition, fact));
  for (const auto& [fluent, value] : state.fluents) named.fluents[fluent_name(definition, fluent)] = value;
  named.fluents.erase("(total-time)");  // predefined; the interpreter does not know it
  return named;
}

// One state as the three see it.
struct Place {
  NaiveState naive;
  LiftedState lifted;
  std::vector<Word> packed;
  double cost = 0.0;  // accumulated by the ground task
};

class Walk {
 public:
  Walk(const std::string& domain, const std::string& problem)
      : naive_(domain, problem),
        task_(make_task(domain, problem)),
        ground_(ground_task(task_.definition(), [] { return false; })),
        space_(ground_),
        actions_(naive_.actions()) {
    for (const GroundOperator& op : ground_.operators) {
      const model::GroundAction action = action_of(ground_, op);
      operators_[{action.name, action.arguments}] = &op;
    }
  }

  Walked run(std::size_t most_states) {
    Walked walked;
    open_.push_back({naive_.initial(), initial_state(task_.definition()), space_.initial(), 0.0});
    seen_.insert(open_.front().naive);
    while (!open_.empty() && !::testing::Test::HasFailure()) {
      const Place place = std::move(open_.front());
      open_.pop_front();
      ++walked.states;
      if (check(place)) ++walked.goals;
      for (const NaiveAction& action : actions_) {
        if (step(place, action, most_states)) ++walked.steps;
      }
    }
    return walked;
  }

 private:
  void check_packed(const Place& place) {
    for (std::size_t f = 0; f < ground_.facts.size(); ++f) {
      const std::string name = fact_name(task_.definition(), ground_.facts[f]);
      EXPECT_EQ(space_.fact(place.packed.data(), static_cast<int>(f)), place.naive.facts.count(name) != 0)
          << name;
    }
    for (std::size_t v = 0; v < ground_.variables.size(); ++v) {
      const std::string name = fluent_name(task_.definition(), ground_.variables[v]);
      const auto found = place.naive.fluents.find(name);
      const double value = space_.value(place.packed.data(), static_cast<int>(v));
      EXPECT_EQ(std::isnan(value), found == place.naive.fluents.end()) << name;
      if (!std::isnan(value) && found != place.naive.fluents.end()) {
        EXPECT_NEAR(value, found->second, 1e-9);
      }
    }
  }

  // True if the goal holds.
  bool check(const Place& place) {
    EXPECT_EQ(named(task_.definition(), place.lifted).facts, place.naive.facts);
    EXPECT_EQ(named(task_.definition(), place.lifted).fluents, place.naive.fluents);
    check_packed(place);
    const bool goal = naive_.goal(place.naive);
    Binding binding(static_cast<std::size_t>(task_.definition().goal_slots), -1);
    EXPECT_EQ(holds(task_.definition(), task_.definition().goal, binding, place.lifted), goal);
    EXPECT_EQ(space_.goal(place.packed.data()), goal);
    EXPECT_FALSE(goal && ground_.unreachable_goal) << *ground_.unreachable_goal;
    if (task_.definition().metric && task_.definition().total_time < 0) check_metric(place);
    return goal;
  }

  void check_metric(const Place& place) {
    const auto metric = naive_.metric(place.naive);
    const auto lifted = Executor(task_.definition(), place.lifted).cost();
    EXPECT_EQ(metric.has_value(), lifted.has_value());
    if (!metric || !lifted) return;
    EXPECT_NEAR(*metric, *lifted, 1e-8);
    const double internal =
        ground_.base_cost + place.cost + space_.evaluate(ground_.potential, place.packed.data());
    EXPECT_NEAR(ground_.maximize ? -internal : internal, *metric, 1e-6);
  }

  // Appends the successor; false if the action is not applicable.
  bool step(const Place& place, const NaiveAction& action, std::size_t most_states) {
    SCOPED_TRACE(action.name + [&] {
      std::string text;
      for (const std::string& argument : action.arguments) text += " " + argument;
      return text;
    }());
    auto next = naive_.apply(place.naive, action);
    Executor executor(task_.definition(), place.lifted);
    const auto failure = executor.step({action.name, action.arguments});
    EXPECT_EQ(!failure.has_value(), next.has_value()) << (failure ? failure->message : "");
    const auto op = operators_.find(action);
    std::vector<Word> packed = place.packed;
    double cost = place.cost;
    bool applied = false;
    if (op != operators_.end() && space_.holds(op->second->precondition, place.packed.data())) {
      applied = space_.apply(*op->second, place.packed.data(), packed.data(), cost);
      EXPECT_TRUE(!applied || next.has_value()) << "only the ground operator can be applied";
    }
    if (!next || failure) return false;
    Place after{std::move(*next), executor.state(), std::move(packed), cost};
    if (!applied) {
      check_nothing_lost(place, after);
      after.packed = place.packed;
    }
    if (seen_.size() < most_states && seen_.insert(after.naive).second) {
      open_.push_back(std::move(after));
    } else {
      check(after);
    }
    return true;
  }

  // An operator may be missing if the search loses nothing by it: nothing that decides changes, nothing gets
  // cheaper. That the rest is the same is what check() sees with the old packed state.
  void check_nothing_lost(const Place& before, Place& after) {
    if (!task_.definition().metric || task_.definition().total_time >= 0) return;
    const auto old_value = naive_.metric(before.naive);
    const auto new_value = naive_.metric(after.naive);
    if (!old_value || !new_value) return;
    const double worse = (*new_value - *old_value) * (ground_.maximize ? -1.0 : 1.0);
    EXPECT_GE(worse, -1e-9) << "an operator that improves the metric is missing";
    after.cost = before.cost + worse;
  }

  Interpreter naive_;
  Task task_;
  GroundTask ground_;
  StateSpace space_;
  std::vector<NaiveAction> actions_;
  std::map<NaiveAction, const GroundOperator*> operators_;
  std::deque<Place> open_;
  std::set<NaiveState> seen_;
};

}  // namespace

Walked expect_same_meaning(const std::string& domain, const std::string& problem, std::size_t most_states) {
  SCOPED_TRACE(domain + problem);
  return Walk(domain, problem).run(most_states);
}

}  // namespace stepwright::pddl::testing

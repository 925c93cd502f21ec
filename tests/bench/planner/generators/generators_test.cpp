// Every generator, every size of the default run and more: the texts parse, the plan that comes along is
// valid and costs no less than the bound, the same seed gives the same text; the planner solves the smallest
// size.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <stdexcept>

#include "supervisor/pddl/plan/validate.h"
#include "supervisor/pddl/planner/solve.h"
#include "tests/bench/planner/generators/instance.h"

namespace stepwright::bench {

// For GoogleTest's messages.
void PrintTo(const Generator& generator, std::ostream* out) {
  *out << generator.name;
}

namespace {

pddl::Task task_of(const Instance& instance) {
  auto task = pddl::parse_task({instance.name() + ".domain", instance.domain},
                               {instance.name() + ".problem", instance.problem});
  if (!task) throw std::runtime_error(result::to_string(task.error()));
  EXPECT_THAT(task->warnings(), testing::IsEmpty()) << instance.name();
  return std::move(*task);
}

class Generators : public testing::TestWithParam<Generator> {};

TEST_P(Generators, Instance_OfEverySize_HasAValidReferencePlanNotBelowTheBound) {
  const Generator& generator = GetParam();
  for (int size = generator.sizes.front(); size <= generator.sizes.back(); ++size) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      const Instance instance = make_instance(generator, size, seed);
      const pddl::Task task = task_of(instance);
      pddl::PlanText plan;
      plan.actions = instance.reference;
      plan.lines.resize(plan.actions.size());
      const pddl::Validation validation = pddl::validate(task, plan);
      ASSERT_TRUE(validation.valid) << instance.name() << " step " << validation.failed_step << " "
                                    << validation.failed_condition << " " << validation.failed_values;
      EXPECT_GE(validation.cost(), instance.lower_bound) << instance.name();
    }
  }
}

TEST_P(Generators, Instance_WithTheSameSeed_IsTheSameAndWithAnotherDiffers) {
  const Generator& generator = GetParam();
  const int size = generator.sizes.back();
  const Instance one = make_instance(generator, size, 1), same = make_instance(generator, size, 1);
  EXPECT_EQ(one.problem, same.problem);
  EXPECT_EQ(one.reference, same.reference);
  EXPECT_EQ(one.digest(), same.digest());
  EXPECT_NE(one.digest(), make_instance(generator, size, 2).digest());
}

TEST_P(Generators, Instance_OfTheSmallestSize_IsSolvedByThePlanner) {
  const Instance instance = make_instance(GetParam(), GetParam().sizes.front(), 1);
  pddl::Options options;
  options.first_only = true;
  options.budget.time = std::chrono::seconds(20);
  const model::Outcome outcome = pddl::solve(task_of(instance), options);
  ASSERT_TRUE(outcome.plan) << instance.name() << ": " << outcome.reason;
  EXPECT_GE(outcome.plan->cost, instance.lower_bound);
}

INSTANTIATE_TEST_SUITE_P(All, Generators, testing::ValuesIn(generators()),
                         [](const auto& each) { return each.param.name; });

TEST(GeneratorList, Names_AreUniqueAndAtLeastTwelve) {
  std::set<std::string> names;
  for (const Generator& generator : generators()) EXPECT_TRUE(names.insert(generator.name).second);
  EXPECT_GE(names.size(), 12u);
}

}  // namespace
}  // namespace stepwright::bench

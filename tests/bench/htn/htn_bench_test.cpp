// The baseline of the benchmark plans what the planner plans.

#include <gtest/gtest.h>

#include "supervisor/htn/search/search.h"
#include "supervisor/htn/task/read_task.h"
#include "tests/bench/htn/plain_decomposition.h"
#include "tests/support/htn/transport.h"

namespace stepwright::bench {
namespace {

TEST(HtnBench, WhenBothPlan_ThenThePlansAreTheSame) {
  const auto read =
      htn::read_task({"d", htn::test::transport_domain()}, {"p", htn::test::ring_problem(8, 4)});
  ASSERT_TRUE(read) << result::to_string(read.error());
  const PlainAnswer plain = decompose_plainly(read->task, std::chrono::steady_clock::time_point::max());
  const auto plan = htn::Search(read->task).next().plan;
  ASSERT_TRUE(plain.solved && plan);
  std::vector<std::string> steps;
  for (const std::size_t step : plan->steps) steps.push_back(to_string(plan->nodes[step]));
  EXPECT_EQ(plain.steps, steps);
}

}  // namespace
}  // namespace stepwright::bench

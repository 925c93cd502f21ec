// Random charts whose conditions trap and have effects, on every engine of this machine, beside an evaluator
// of sfc_semantics.md. Long runs: STEPWRIGHT_FUZZ_CHARTS=20000 STEPWRIGHT_FUZZ_SEED=7 st_fuzz
// --gtest_filter=*Charts*

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/fuzz/st/condition_chart.h"
#include "tests/fuzz/st/engines.h"

namespace {

using namespace stepwright::st_fuzz;

constexpr int kScans = 30;

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::string difference(const Engines& engines, const ChartValues& values) {
  std::string out;
  const auto compare = [&](const std::string& path, Scalar type, std::int64_t expected) {
    const auto found = static_cast<std::int64_t>(engines.get(path, type));
    if (found != expected)
      out += path + " is " + std::to_string(found) + ", not " + std::to_string(expected) + "; ";
  };
  for (std::size_t i = 0; i < values.steps.size(); ++i)
    compare("main.S" + std::to_string(i) + "_X", Scalar::Bool, values.steps[i] ? 1 : 0);
  for (std::size_t i = 0; i < values.numbers.size(); ++i)
    compare("main.d" + std::to_string(i), Scalar::Dint, values.numbers[i]);
  for (std::size_t i = 0; i < values.counters.size(); ++i)
    compare((i == 3 ? "c" : "main.c") + std::to_string(i), Scalar::Dint, values.counters[i]);
  return out;
}

struct Seen {
  std::uint64_t traps = 0;
  std::uint64_t counts = 0;
  std::uint64_t steps = 0;
};

void run(const ConditionChart& chart, Random& random, Seen& seen) {
  Engines engines(chart.text());
  ConditionChartRun expected(chart);
  for (int scan = 1; scan <= kScans; ++scan) {
    std::array<bool, kChartInputs> inputs{};
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      inputs[i] = random.chance(50);
      engines.set("main.in" + std::to_string(i), Scalar::Bool, inputs[i] ? 1 : 0);
    }
    const bool goes_on = expected.scan(inputs);
    ASSERT_EQ(engines.scan(), "") << "scan " << scan << "\n" << chart.text();
    using stepwright::bytecode::TrapCode;
    ASSERT_EQ(engines.trap().code, goes_on ? TrapCode::None : TrapCode::DivisionByZero)
        << "scan " << scan << "\n"
        << chart.text();
    if (!goes_on) {
      ++seen.traps;
      return;
    }
    ASSERT_EQ(difference(engines, expected.values()), "") << "scan " << scan << "\n" << chart.text();
  }
  for (const std::int64_t each : expected.values().counters) seen.counts += each > 0 ? 1 : 0;
  for (std::size_t i = 1; i < chart.steps.size(); ++i) seen.steps += expected.values().steps[i] ? 1 : 0;
}

TEST(StFuzz, Charts_WhenConditionsTrapAndHaveEffects_ThenOnlyThoseOfEnabledTransitionsDo) {
  const std::uint64_t seed = setting("STEPWRIGHT_FUZZ_SEED", 1);
  const std::uint64_t charts = setting("STEPWRIGHT_FUZZ_CHARTS", 300);
  Seen seen;
  for (std::uint64_t i = 0; i < charts && !HasFailure(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed + i));
    Random random(seed + i);
    const ConditionChart chart = random_condition_chart(random);
    run(chart, random, seen);
  }
  std::cout << charts << " charts: " << seen.traps << " end with a trap, " << seen.counts << " counters, "
            << seen.steps << " other steps active at the end\n";
  EXPECT_GT(seen.traps, charts / 20);
  EXPECT_LT(seen.traps, charts * 3 / 4);
  EXPECT_GT(seen.counts, charts / 20);
  EXPECT_GT(seen.steps, charts / 10);
}

}  // namespace

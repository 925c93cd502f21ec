// Linear programs against known optima, against integer points, and warm against cold.

#include "supervisor/pddl/search/lp/lp_program.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace stepwright::pddl {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
const std::function<bool()> kNever = [] { return false; };
constexpr int kMany = 100'000;

LpRow row(std::vector<double> coefficients, double low) {
  LpRow result;
  result.low = low;
  for (std::size_t c = 0; c < coefficients.size(); ++c) {
    if (coefficients[c] != 0.0) result.entries.push_back({static_cast<int>(c), coefficients[c]});
  }
  return result;
}

TEST(LpProgram, WhenSolved_ThenTheOptimumIsTheBound) {
  LpProgram program({1.0, 2.0}, {row({1.0, 3.0}, 5.0)});
  const LpSolution solution = program.minimize(kNever, kMany);
  EXPECT_TRUE(solution.finished);
  EXPECT_NEAR(solution.bound, 10.0 / 3.0, 1e-9);
  EXPECT_NEAR(program.reduced_costs()[0], 1.0 / 3.0, 1e-9);
  EXPECT_NEAR(program.reduced_costs()[1], 0.0, 1e-9);
}

TEST(LpProgram, WhenNothingMeetsTheRows_ThenInfinite) {
  LpProgram program({1.0, 1.0}, {row({1.0, -1.0}, 1.0), row({-1.0, 1.0}, 0.0)});
  EXPECT_EQ(program.minimize(kNever, kMany).bound, kInfinite);
  program.set_low(0, -1.0);
  EXPECT_EQ(program.minimize(kNever, kMany).bound, 0.0);
  program.set_low(0, 1.0);
  program.set_low(1, -kInfinite);
  EXPECT_NEAR(program.minimize(kNever, kMany).bound, 1.0, 1e-9);
}

TEST(LpProgram, WhenThereIsNothingToWeigh_ThenRowsWithoutEntriesDecide) {
  LpProgram none({}, {});
  EXPECT_EQ(none.minimize(kNever, kMany).bound, 0.0);
  LpProgram empty({1.0}, {row({0.0}, 0.0), row({1.0}, 2.0)});
  EXPECT_NEAR(empty.minimize(kNever, kMany).bound, 2.0, 1e-9);
  empty.set_low(0, 1.0);
  EXPECT_EQ(empty.minimize(kNever, kMany).bound, kInfinite);
  empty.set_low(0, -1.0);
  EXPECT_NEAR(empty.minimize(kNever, kMany).bound, 2.0, 1e-9);
}

TEST(LpProgram, WhenRowsComeAndGo_ThenTheBoundFollows) {
  LpProgram program({1.0, 1.0, 1.0}, {row({1.0, 1.0, 0.0}, 2.0)});
  EXPECT_NEAR(program.minimize(kNever, kMany).bound, 2.0, 1e-9);
  for (int i = 0; i < 3; ++i) {
    program.add_rows(std::vector<LpRow>{row({0.0, 0.0, 1.0}, 4.0), row({1.0, -1.0, 0.0}, 1.0)});
    program.add_rows(std::vector<LpRow>{row({0.0, 2.0, 0.0}, 3.0)});
    EXPECT_EQ(program.rows(), 4u);
    EXPECT_NEAR(program.minimize(kNever, kMany).bound, 8.0, 1e-9);
    program.drop_rows();
    EXPECT_EQ(program.rows(), 1u);
    EXPECT_NEAR(program.minimize(kNever, kMany).bound, 2.0, 1e-9);
  }
}

// Six columns, rows with small coefficients of both signs.
struct Drawn {
  std::vector<double> costs;
  std::vector<LpRow> rows;
};

Drawn draw(std::mt19937& random) {
  const auto pick = [&](int low, int high) {
    return static_cast<double>(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
  };
  Drawn drawn;
  for (int c = 0; c < 4; ++c) drawn.costs.push_back(pick(0, 5));
  for (int r = 0; r < 5; ++r) {
    drawn.rows.push_back(row({pick(-2, 3), pick(-2, 3), pick(-2, 3), pick(-2, 3)}, pick(-2, 4)));
  }
  return drawn;
}

// The cheapest point with integers from 0 to 6.
double cheapest_point(const Drawn& drawn) {
  double best = kInfinite;
  for (int code = 0; code < 7 * 7 * 7 * 7; ++code) {
    const int x[] = {code % 7, code / 7 % 7, code / 49 % 7, code / 343};
    double cost = 0.0;
    for (std::size_t c = 0; c < 4; ++c) cost += drawn.costs[c] * x[c];
    bool meets = cost < best;
    for (const LpRow& r : drawn.rows) {
      double sum = 0.0;
      for (const LpEntry& entry : r.entries) sum += entry.coefficient * x[entry.column];
      meets = meets && sum >= r.low;
    }
    if (meets) best = cost;
  }
  return best;
}

TEST(LpProgram, WhenDrawnAtRandom_ThenNoPointIsCheaperThanTheBoundAndWarmIsCold) {
  std::mt19937 random(7);
  int infeasible = 0, positive = 0;
  for (int i = 0; i < 300; ++i) {
    Drawn drawn = draw(random);
    LpProgram warm(drawn.costs, drawn.rows);
    for (int change = 0; change < 4; ++change) {
      const double bound = warm.minimize(kNever, kMany).bound;
      LpProgram cold(drawn.costs, drawn.rows);
      const double again = cold.minimize(kNever, kMany).bound;
      ASSERT_EQ(bound == kInfinite, again == kInfinite);
      if (bound < kInfinite) {
        ASSERT_NEAR(bound, again, 1e-6);
      }
      ASSERT_LE(bound, cheapest_point(drawn) + 1e-6);
      infeasible += bound == kInfinite ? 1 : 0;
      positive += bound > 0.5 && bound < kInfinite ? 1 : 0;
      const std::size_t changed = random() % drawn.rows.size();
      drawn.rows[changed].low = static_cast<double>(random() % 7) - 2.0;
      warm.set_low(changed, drawn.rows[changed].low);
    }
  }
  EXPECT_GT(infeasible, 20);
  EXPECT_GT(positive, 200);
}

// A transport problem that takes hundreds of iterations.
LpProgram transport(int places) {
  std::mt19937 random(3);
  std::vector<double> costs;
  std::vector<LpRow> rows(2 * static_cast<std::size_t>(places));
  for (int from = 0; from < places; ++from) {
    for (int to = 0; to < places; ++to) {
      const int column = static_cast<int>(costs.size());
      costs.push_back(1.0 + static_cast<double>(random() % 50));
      rows[static_cast<std::size_t>(from)].entries.push_back({column, -1.0});
      rows[static_cast<std::size_t>(places + to)].entries.push_back({column, 1.0});
    }
  }
  for (int i = 0; i < places; ++i) {
    rows[static_cast<std::size_t>(i)].low = -3.0 - static_cast<double>(random() % 3);
    rows[static_cast<std::size_t>(places + i)].low = 1.0 + static_cast<double>(random() % 3);
  }
  return {costs, rows};
}

TEST(LpProgram, WhenToldToStop_ThenItStopsAtThatIterationAndItsBoundHolds) {
  LpProgram whole = transport(120);
  const LpSolution optimum = whole.minimize(kNever, kMany);
  ASSERT_TRUE(optimum.finished);
  ASSERT_GT(optimum.iterations, 100);
  for (const int allowed : {0, 1, 10, 60}) {
    LpProgram program = transport(120);
    int asked = 0;
    const LpSolution stopped = program.minimize([&] { return ++asked > allowed; }, kMany);
    EXPECT_FALSE(stopped.finished);
    EXPECT_EQ(asked, allowed + 1);
    EXPECT_LE(stopped.iterations, allowed + 1);
    EXPECT_LE(stopped.bound, optimum.bound + 1e-6);
    const LpSolution limited = program.minimize(kNever, 5);
    EXPECT_FALSE(limited.finished);
    EXPECT_LE(limited.bound, optimum.bound + 1e-6);
    EXPECT_NEAR(program.minimize(kNever, kMany).bound, optimum.bound, 1e-6);
  }
}

}  // namespace
}  // namespace stepwright::pddl

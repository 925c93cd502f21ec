#include "plant_models/ode/cvode_solver.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace stepwright::ode {
namespace {

// A harmonic oscillator, y'' = -y, with a root at y = level.
class Oscillator final : public OdeSystem {
 public:
  double level = 0.0;
  double dies_at = std::numeric_limits<double>::infinity();

  std::size_t state_size() const override { return 2; }
  std::size_t root_count() const override { return 1; }
  void derivative(double t, std::span<const double> y, std::span<double> dydt) const override {
    dydt[0] = y[1];
    dydt[1] = t < dies_at ? -y[0] : std::numeric_limits<double>::quiet_NaN();
  }
  void roots(double, std::span<const double> y, std::span<double> g) const override { g[0] = y[0] - level; }
};

constexpr std::array<double, 2> kStart = {1.0, 0.0};

CvodeSettings settings() {
  return {.relative_tolerance = 1e-8, .absolute_tolerance = {1e-10, 1e-10}};
}

CvodeSolver make(const OdeSystem& system) {
  auto solver = CvodeSolver::create(system, kStart, 0.0, settings());
  EXPECT_TRUE(solver.has_value());
  return std::move(*solver);
}

TEST(CvodeSolver, WhenSystemIsSmooth_ThenSolutionIsExactToTheTolerance) {
  Oscillator system;
  system.level = 5.0;  // never reached
  CvodeSolver solver = make(system);
  std::array<double, 2> y{};
  for (double t = 0.05; t < 20.0; t += 0.05) {
    while (solver.time() < t) ASSERT_EQ(solver.step(), StepOutcome::Stepped);
    ASSERT_TRUE(solver.state_at(t, y));
    ASSERT_NEAR(y[0], std::cos(t), 1e-6);
    ASSERT_NEAR(y[1], -std::sin(t), 1e-6);
  }
}

TEST(CvodeSolver, WhenRootFunctionChangesSign_ThenStepEndsThereWithDirection) {
  Oscillator system;
  CvodeSolver solver = make(system);
  const auto run_to_root = [&solver] {
    StepOutcome outcome = StepOutcome::Stepped;
    while (outcome == StepOutcome::Stepped) outcome = solver.step();
    return outcome;
  };
  ASSERT_EQ(run_to_root(), StepOutcome::Root);
  EXPECT_NEAR(solver.time(), std::acos(-1.0) / 2.0, 1e-6);
  EXPECT_EQ(solver.roots()[0], -1);
  ASSERT_EQ(run_to_root(), StepOutcome::Root);
  EXPECT_NEAR(solver.time(), 3.0 * std::acos(-1.0) / 2.0, 1e-6);
  EXPECT_EQ(solver.roots()[0], 1);
}

TEST(CvodeSolver, WhenRestarted_ThenGoesOnFromTheNewState) {
  Oscillator system;
  system.level = 5.0;
  CvodeSolver solver = make(system);
  while (solver.time() < 1.0) ASSERT_EQ(solver.step(), StepOutcome::Stepped);
  const std::array<double, 2> again = {0.0, 2.0};
  ASSERT_TRUE(solver.restart(1.0, again));
  EXPECT_EQ(solver.time(), 1.0);
  while (solver.time() < 2.0) ASSERT_EQ(solver.step(), StepOutcome::Stepped);
  std::array<double, 2> y{};
  ASSERT_TRUE(solver.state_at(2.0, y));
  EXPECT_NEAR(y[0], 2.0 * std::sin(1.0), 1e-6);
  EXPECT_EQ(solver.statistics().restarts, 1);
}

TEST(CvodeSolver, WhenAskedOutsideTheLastStep_ThenRefusesAndWritesNothing) {
  Oscillator system;
  CvodeSolver solver = make(system);
  while (solver.time() < 1.0) ASSERT_EQ(solver.step(), StepOutcome::Stepped);
  std::array<double, 2> y = {7.0, 7.0};
  EXPECT_FALSE(solver.state_at(solver.time() + 0.01, y));
  EXPECT_FALSE(solver.state_at(0.0, y));
  EXPECT_FALSE(solver.state_at(std::numeric_limits<double>::quiet_NaN(), y));
  EXPECT_EQ(y[0], 7.0);
}

TEST(CvodeSolver, WhenDerivativeIsNotFinite_ThenStepFailsForGoodAndStateStays) {
  Oscillator system;
  system.level = 5.0;
  system.dies_at = 1.0;
  CvodeSolver solver = make(system);
  StepOutcome outcome = StepOutcome::Stepped;
  while (outcome == StepOutcome::Stepped) outcome = solver.step();
  EXPECT_EQ(outcome, StepOutcome::Failed);
  EXPECT_EQ(solver.step(), StepOutcome::Failed);
  EXPECT_LE(solver.time(), 1.0 + 1e-9);
  std::array<double, 2> y{};
  ASSERT_TRUE(solver.state_at(solver.time(), y));
  EXPECT_NEAR(y[0], std::cos(solver.time()), 1e-5);
  EXPECT_FALSE(solver.restart(1.0, kStart));
}

TEST(CvodeSolver, WhenSettingsDoNotFit_ThenCreateFails) {
  const Oscillator system;
  const std::array<double, 1> short_state = {1.0};
  const std::array<double, 2> endless = {1.0, std::numeric_limits<double>::infinity()};
  EXPECT_FALSE(CvodeSolver::create(system, short_state, 0.0, settings()));
  EXPECT_FALSE(CvodeSolver::create(system, endless, 0.0, settings()));
  const auto broken = [&](auto change) {
    CvodeSettings s = settings();
    change(s);
    auto solver = CvodeSolver::create(system, kStart, 0.0, s);
    return !solver && solver.error().front().code == "C0331";
  };
  EXPECT_TRUE(broken([](CvodeSettings& s) { s.absolute_tolerance.pop_back(); }));
  EXPECT_TRUE(broken([](CvodeSettings& s) { s.absolute_tolerance[0] = 0.0; }));
  EXPECT_TRUE(broken([](CvodeSettings& s) { s.relative_tolerance = -1.0; }));
  EXPECT_TRUE(broken([](CvodeSettings& s) { s.max_step_s = 0.0; }));
  EXPECT_TRUE(broken([](CvodeSettings& s) { s.max_order = 13; }));
}

}  // namespace
}  // namespace stepwright::ode

#include "supervisor/fleet/control/predictive_controller.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "tests/support/malloc_guard.h"

namespace stepwright::fleet {
namespace {

constexpr geometry::Footprint kOutline{.front_m = 1.6, .rear_m = 2.4, .half_width_m = 0.7};

// Along the x axis at a speed, from x = 0 on.
Reference straight(double speed_m_s, std::span<const geometry::HalfPlane> area = {}) {
  Reference reference;
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    reference[k].state.x_m = speed_m_s * kControlStep_s * static_cast<double>(k);
    reference[k].state.speed_m_s = speed_m_s;
    reference[k].area = area;
  }
  return reference;
}

TEST(PredictiveController, WhenItIsOnTheReference_ThenItDoesNothing) {
  PredictiveController controller({}, kOutline, {});
  const auto& made = controller.solve({.speed_m_s = 1.0}, straight(1.0));
  EXPECT_NEAR(made.cost, 0.0, 1e-9);
  EXPECT_NEAR(made.acceleration_m_s2, 0.0, 1e-9);
  EXPECT_NEAR(made.lock_rate_rad_s, 0.0, 1e-9);
}

TEST(PredictiveController, WhenItIsBesideTheReference_ThenItSteersBackForwardAndInReverse) {
  for (const double speed : {1.0, -1.0}) {
    PredictiveController controller({}, kOutline, {});
    VehicleState now{.y_m = 0.3, .speed_m_s = speed};
    const auto& made = controller.solve(now, straight(speed));
    EXPECT_LT(std::abs(made.states.back().y_m), 0.15) << speed;
    EXPECT_LT(made.lock_rate_rad_s, 0.0) << speed;  // to the right; in reverse the rear goes there first
  }
}

TEST(PredictiveController, WhenTheReferenceIsOutOfReach_ThenTheDrivesLimitsHold) {
  const DriveLimits limits;
  PredictiveController controller(limits, kOutline, {});
  const auto& made = controller.solve({.x_m = -5.0, .y_m = 3.0, .heading_rad = 1.0}, straight(1.5));
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const VehicleState& a = made.states[k];
    const VehicleState& b = made.states[k + 1];
    EXPECT_LE(std::abs(b.speed_m_s - a.speed_m_s), limits.hard_brake_m_s2 * kControlStep_s + 1e-9);
    EXPECT_LE(std::abs(b.lock_rad - a.lock_rad), limits.lock_rate_rad_s * kControlStep_s + 1e-9);
    EXPECT_LE(std::abs(b.lock_rad), limits.full_lock_rad + 1e-12);
    EXPECT_LE(std::abs(b.speed_m_s), limits.top_speed_m_s + 1e-12);
  }
}

TEST(PredictiveController, WhenAnAreaIsNarrowerThanTheReferenceAsks_ThenTheOutlineStaysInside) {
  // The reference runs 0.2 m too far left: a wall at y = 0.75 leaves 5 cm beside a vehicle at y = 0.
  const std::array<geometry::HalfPlane, 1> area = {geometry::HalfPlane{{0.0, 1.0}, 0.75}};
  Reference reference = straight(1.0, area);
  for (auto& each : reference) each.state.y_m = 0.2;
  const auto leftmost = [&](double weight) {
    ControllerWeights weights;
    weights.area = weight;
    weights.margin_m = 0.0;
    PredictiveController controller({}, kOutline, weights);
    double most = -1.0;
    for (const VehicleState& state : controller.solve({.speed_m_s = 1.0}, reference).states) {
      const auto box = geometry::footprint_at({state.x_m, state.y_m, state.heading_rad}, kOutline);
      most = std::max(most, box.bounds().high.y_m);
    }
    return most;
  };
  EXPECT_GT(leftmost(0.0), 0.80);
  EXPECT_LT(leftmost(4000.0), 0.76);
}

TEST(PredictiveController, WhenItBeginsWithAnotherSolution_ThenItComesToTheSameCost) {
  PredictiveController controller({}, kOutline, {});
  const VehicleState now{.x_m = 0.2, .y_m = 0.4, .heading_rad = -0.2, .speed_m_s = 0.5, .lock_rad = 0.1};
  const double cold = controller.solve(now, straight(1.0)).cost;
  controller.solve({.y_m = -1.0, .heading_rad = 0.4, .speed_m_s = 1.2}, straight(0.5));
  EXPECT_NEAR(controller.solve(now, straight(1.0)).cost, cold, 0.01 * cold);
  controller.reset();
  EXPECT_EQ(controller.solve(now, straight(1.0)).cost, cold);
}

TEST(PredictiveController, WhenItSolves_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  PredictiveController controller({}, kOutline, {});
  const Reference reference = straight(1.0);
  controller.solve({}, reference);
  const support::GuardCounts before = support::guard_counts();
  for (int k = 0; k < 50; ++k) controller.solve({.y_m = 0.01 * k, .speed_m_s = 0.5}, reference);
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::fleet

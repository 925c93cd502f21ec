#include "supervisor/fleet/control/speed_plan.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/unit/supervisor/fleet/control/made_path.h"

namespace stepwright::fleet {
namespace {

Leg made(const MadePath& path) {
  return split_into_legs(path.path(), 1.9).front();
}

// Until it stands still; the greatest speed on the way.
struct Drive {
  Progress end;
  double fastest_m_s = 0.0;
};
Drive run(const SpeedPlan& plan, const Clearance& clearance) {
  Drive run;
  for (int k = 0; k < 1000; ++k) {
    run.end = plan.advance(run.end, 0.1, clearance);
    run.fastest_m_s = std::max(run.fastest_m_s, run.end.speed_m_s);
  }
  return run;
}

TEST(SpeedPlan, WhenNothingHoldsIt_ThenItGoesAtTopSpeedAndStopsAtTheEnd) {
  const DriveLimits limits;
  const SpeedPlan plan(made(MadePath({0, 0, 0}).drive(20.0)), limits);
  const Drive all = run(plan, {});
  EXPECT_NEAR(all.end.arc_m, 20.0, 0.03);
  EXPECT_NEAR(all.fastest_m_s, limits.top_speed_m_s, 1e-9);
  double before = 0.0;
  for (double arc = 0.0; arc <= 20.0; arc += 0.01) {
    const double speed = plan.ceiling_m_s(arc);
    EXPECT_GE(speed * speed, before * before - 2.0 * limits.brake_m_s2 * 0.01 - 1e-9);  // it can brake so
    before = speed;
  }
}

TEST(SpeedPlan, WhenACurveIsSharp_ThenTheSpeedKeepsTheLateralAcceleration) {
  DriveLimits limits;
  limits.lateral_m_s2 = 0.2;
  const SpeedPlan plan(made(MadePath({0, 0, 0}).drive(10.0).drive(6.0, 0.25).drive(10.0)), limits);
  for (double arc = 10.0; arc <= 16.0; arc += 0.1) {
    EXPECT_LE(plan.ceiling_m_s(arc), std::sqrt(0.2 / 0.25) + 1e-6) << arc;
  }
  EXPECT_GT(plan.ceiling_m_s(5.0), 1.4);
}

TEST(SpeedPlan, WhenItMayGoNoFurther_ThenItStopsBeforeAndGoesOnLater) {
  const SpeedPlan plan(made(MadePath({0, 0, 0}).drive(20.0)), {});
  const Drive held = run(plan, {.permitted_m = 8.0, .gates = {}});
  EXPECT_LE(held.end.arc_m, 8.0 + 1e-6);
  EXPECT_GT(held.end.arc_m, 7.9);
}

TEST(SpeedPlan, WhenAGateIsTooEarly_ThenItIsApproachedSlowlyAndPassedInTime) {
  const SpeedPlan plan(made(MadePath({0, 0, 0}).drive(20.0)), {});
  const std::array<Gate, 2> gates = {Gate{6.0, 12.0}, Gate{12.0, 30.0}};
  Progress now;
  std::array<double, 2> passed{};
  bool stood = false;
  while (now.arc_m < 19.9 && now.time_s < 100.0) {
    now = plan.advance(now, 0.1, {.gates = gates});
    if (now.time_s > 1.0 && now.arc_m < 19.0) stood = stood || now.speed_m_s < 0.05;
    for (std::size_t k = 0; k < gates.size(); ++k) {
      if (passed[k] == 0.0 && now.arc_m >= gates[k].arc_m) passed[k] = now.time_s;
    }
  }
  EXPECT_GE(passed[0], 12.0 - 0.1);
  EXPECT_LE(passed[0], 12.5);
  EXPECT_GE(passed[1], 30.0 - 0.1);
  EXPECT_LE(passed[1], 30.5);
  EXPECT_FALSE(stood);
}

}  // namespace
}  // namespace stepwright::fleet

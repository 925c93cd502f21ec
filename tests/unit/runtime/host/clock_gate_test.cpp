#include "runtime/host/clock_gate.h"

#include <gtest/gtest.h>

namespace stepwright::host {
namespace {

constexpr std::int64_t kMs = 1'000'000;

HostConfig simulated(double speed = 0.0) {
  HostConfig config;
  config.clock = ClockMode::Simulated;
  config.speed = speed;
  return config;
}

TEST(ClockGate, WhenABarrierHolds_ThenTheClockStandsUntilItIsReleased) {
  ClockGate gate(simulated());
  gate.arm(true);
  gate.begin({0, 0, 0});
  gate.stand({10 * kMs, 30 * kMs, 40 * kMs});
  EXPECT_TRUE(gate.waits_for_supervisor());
  EXPECT_FALSE(gate.may_scan());
  gate.release({90 * kMs, 30 * kMs, 40 * kMs});
  EXPECT_TRUE(gate.may_scan());
  EXPECT_EQ(gate.factor(100 * kMs, 60 * kMs), 3.0) << "what it stood does not count";
}

TEST(ClockGate, WhenNobodyWantedABarrier_ThenAStepChangeHoldsNothing) {
  ClockGate gate(simulated());
  gate.arm(false);
  gate.stand({});
  EXPECT_TRUE(gate.may_scan());
}

TEST(ClockGate, WhenTheSupervisorIsLost_ThenOnlyASimulationWithASpeedGoesOn) {
  for (const double speed : {0.0, 2.0}) {
    ClockGate gate(simulated(speed));
    gate.arm(true);
    gate.begin({});
    gate.stand({});
    gate.supervisor_is_lost({});
    EXPECT_EQ(gate.may_scan(), speed > 0.0);
    gate.supervisor_is_there();
    gate.stand({});
    EXPECT_TRUE(gate.waits_for_supervisor());
  }
}

TEST(ClockGate, WhenAPersonSteps_ThenSoManyScansRunWithoutASpeed) {
  ClockGate gate(simulated(1.0));
  gate.arm(true);
  gate.begin({0, 0, 0});
  gate.step(2, {10 * kMs, 10 * kMs, 20 * kMs});
  EXPECT_FALSE(gate.keeps_step());
  EXPECT_FALSE(gate.scanned());
  EXPECT_TRUE(gate.may_scan());
  EXPECT_TRUE(gate.scanned());
  EXPECT_FALSE(gate.may_scan());
  EXPECT_EQ(gate.factor(500 * kMs, 30 * kMs), 1.0) << "a person's time says nothing about speed";
  gate.go_on(/*running=*/true, {500 * kMs, 30 * kMs, 40 * kMs});
  EXPECT_TRUE(gate.keeps_step());
  EXPECT_EQ(gate.wait_ns(500 * kMs, 60 * kMs), 20 * kMs);
}

TEST(ClockGate, WhenAPersonLetsItGoOnAtABarrier_ThenThatStillHoldsIt) {
  ClockGate gate(simulated());
  gate.arm(true);
  gate.begin({});
  gate.stand({});
  gate.step(1, {});
  gate.go_on(/*running=*/true, {});
  EXPECT_FALSE(gate.may_scan());
  gate.release({});
  EXPECT_TRUE(gate.may_scan());
}

TEST(ClockGate, WhenTheProgramStopsAtABarrier_ThenNobodyIsWaitedFor) {
  ClockGate gate(simulated());
  gate.arm(true);
  gate.begin({});
  gate.stand({});
  gate.rest({});
  EXPECT_FALSE(gate.waits_for_supervisor());
}

}  // namespace
}  // namespace stepwright::host

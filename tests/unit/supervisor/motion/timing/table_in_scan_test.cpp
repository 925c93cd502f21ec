// Tables of the planner in the scan: MC_MovePath of the standard library follows them, slower and faster, on
// the planner's path and within what the table promises.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <string>

#include "supervisor/motion/blend/blend.h"
#include "supervisor/motion/timing/motion_table.h"
#include "supervisor/motion/timing/plan_timing.h"
#include "tests/support/engine_program/engine_program.h"

namespace stepwright::motion {
namespace {

constexpr std::size_t kJoints = 7, kMostRows = 1024;
constexpr double kScan_s = 0.004;
constexpr const char* kProgram = R"(
PROGRAM main
VAR
  arm : AXES_GROUP; enable : MC_GroupEnable; slower : MC_GroupSetOverride; move : MC_MovePath; run : MC_RunAxesGroup;
  path : MC_PATH; points : ARRAY[0..15] OF MC_WAY_POINT; rows : ARRAY[0..1023] OF MC_TIME_ROW; factor : LREAL := 1.0;
END_VAR
  enable(Execute := TRUE, AxesGroup := arm);
  slower(Enable := TRUE, VelFactor := factor, AxesGroup := arm);
  move(Execute := TRUE, Path := path, Points := points, Rows := rows, AxesGroup := arm);
  run(CYCLE := T#4ms, AxesGroup := arm);
  arm.ActualPosition := arm.SetPosition;
END_PROGRAM
)";

std::string joint(const std::string& name, std::size_t j) {
  return name + "[" + std::to_string(j + 1) + "]";
}

class Scan {
 public:
  template <typename T>
  void set(const std::string& name, T value) {
    std::memcpy(&program_.memory()[address(name)], &value, sizeof value);
  }
  double number(const std::string& name) {
    double value = 0.0;
    std::memcpy(&value, &program_.memory()[address(name)], sizeof value);
    return value;
  }
  bool is_on(const std::string& name) { return program_.memory()[address(name)] != std::byte{0}; }
  bool step() { return program_.scan(4'000'000LL * scans_++); }

  void set(const MotionTable& table) {
    set("path.Points", static_cast<std::int32_t>(table.places.size()));
    set("path.Rows", static_cast<std::int32_t>(table.rows()));
    set("path.Duration", table.begins_s.back());
    set("path.RateSlope", table.override_rates.per_s);
    set("path.RateBend", table.override_rates.per_s2);
    for (std::size_t k = 0; k < table.places.size(); ++k) set_point(table, k);
    for (std::size_t k = 0; k < table.rows(); ++k) {
      const std::string row = "rows[" + std::to_string(k) + "].";
      set(row + "T", table.begins_s[k]);
      set(row + "R", table.rates[k]);
      for (std::size_t c = 0; c < 6; ++c) set(row + "C" + std::to_string(c), table.coefficients[6 * k + c]);
    }
    for (std::size_t j = 0; j < kJoints; ++j) set(joint("arm.ActualPosition", j), table.points[j]);
  }

 private:
  std::uint32_t address(const std::string& name) const { return program_.variable("main." + name).address; }

  void set_point(const MotionTable& table, std::size_t k) {
    const std::string point = "points[" + std::to_string(k) + "].";
    set(point + "S", table.places[k]);
    set(point + "H", table.half_widths[k]);
    for (std::size_t j = 0; j < kJoints; ++j) {
      set(joint(point + "Q", j), table.points[k * kJoints + j]);
      if (k + 1 < table.places.size()) set(joint(point + "U", j), table.directions[k * kJoints + j]);
    }
  }

  support::EngineProgram program_{support::compile_st(kProgram), support::EngineKind::Native};
  std::int64_t scans_ = 0;
};

// The greatest so far: how far a joint was off its path, and parts of the limits by differences of set
// points.
struct Worst {
  double off = 0.0, velocity = 0.0, acceleration = 0.0, jerk = 0.0;
};

class Differences {
 public:
  Differences(const JointLimits& planned, const StopLimits& stop) : planned_(planned), stop_(stop) {}

  void add(std::size_t j, double q, Worst& worst) {
    const double v = (q - q_[j]) / kScan_s, a = (v - v_[j]) / kScan_s, b = (a - a_[j]) / kScan_s;
    if (begun_) {
      worst.velocity = std::max(worst.velocity, std::abs(v) / planned_.velocity[j]);
      worst.acceleration = std::max(worst.acceleration, std::abs(a) / stop_.acceleration[j]);
      worst.jerk = std::max(worst.jerk, std::abs(b) / stop_.jerk[j]);
      v_[j] = v;
      a_[j] = a;
    }
    q_[j] = q;
    if (j + 1 == kJoints) begun_ = true;
  }

 private:
  const JointLimits& planned_;
  const StopLimits& stop_;
  bool begun_ = false;
  std::array<double, kJoints> q_{}, v_{}, a_{};
};

TEST(TableInScan, WhenOverridesComeAndGo_ThenTheBlockStaysOnThePlannersPathWithinItsLimits) {
  std::mt19937 random(3);
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(random()) / 4294967296.0;
  };
  const std::vector<double> velocity(kJoints, 2.0), acceleration(kJoints, 6.0), jerk(kJoints, 60.0);
  const JointLimits limits{velocity, acceleration, jerk};
  const auto stop = stop_limits(limits);
  for (int round = 0; round < 6; ++round) {
    JointPath way(3 + random() % 6, Configuration(kJoints));
    for (Configuration& each : way)
      for (double& q : each) q = between(-1.0, 1.0);
    const auto path = blend(way, {.tolerance = 0.05});
    ASSERT_TRUE(path);
    const auto law = plan_timing(*path, limits);
    ASSERT_TRUE(law);
    const auto table = motion_table(*path, *law, limits, stop);
    ASSERT_TRUE(table);
    ASSERT_LE(table->rows(), kMostRows);
    Scan scan;
    scan.set(*table);
    Worst worst;
    Differences differences(limits, stop);
    constexpr int kMostScans = 20'000, kFullAgain = 3'000;
    for (int k = 0; k < kMostScans && !scan.is_on("move.Done"); ++k) {
      if (k % 97 == 50) scan.set("factor", k > kFullAgain || random() % 3 == 0 ? 1.0 : between(0.0, 1.0));
      const double time_s = scan.number("arm.Time");
      ASSERT_TRUE(scan.step());
      ASSERT_FALSE(scan.is_on("move.Error"));
      Configuration planned(kJoints);
      path->at(law->at(time_s).place, planned);
      for (std::size_t j = 0; j < kJoints; ++j) {
        const double q = scan.number(joint("arm.SetPosition", j));
        worst.off = std::max(worst.off, std::abs(q - planned[j]));
        differences.add(j, q, worst);
      }
    }
    EXPECT_TRUE(scan.is_on("move.Done"));
    EXPECT_LT(worst.off, 1e-9);
    EXPECT_LE(worst.velocity, 1.000001);
    EXPECT_LE(worst.acceleration, 1.001);
    EXPECT_LE(worst.jerk, 1.01);
  }
}

}  // namespace
}  // namespace stepwright::motion

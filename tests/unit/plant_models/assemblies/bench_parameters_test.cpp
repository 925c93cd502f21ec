#include "plant_models/assemblies/bench_parameters.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "plant_models/assemblies/tank_bench.h"

namespace stepwright::assemblies {
namespace {

TEST(BenchParameters, WhenDefault_ThenValid) {
  const auto valid = validate({});
  EXPECT_TRUE(valid) << result::to_string(valid.error());
}

TEST(BenchParameters, WhenOneFigureIsWrong_ThenRefusedAndNoPlantIsMade) {
  const std::vector<std::function<void(BenchParameters&)>> mistakes = {
      [](auto& p) { p.tanks[1].capacity_l = 0.0; },
      [](auto& p) { p.tanks[2].initial_percent = 101.0; },
      [](auto& p) { p.tanks[3].initial_percent = std::numeric_limits<double>::quiet_NaN(); },
      [](auto& p) { p.tanks[0].initial_percent = 100.0; },  // cannot hold everything
      [](auto& p) { p.pumps[0].time_constant_s = -0.1; },
      [](auto& p) { p.pumps[1].lift_m = 0.2; },  // siphons
      [](auto& p) { p.pumps[2].resistance_m_per_m3_s = 0.0; },
      [](auto& p) { p.vehicle.empty_mass_kg = 0.0; },
      [](auto& p) { p.vehicle.drive_force_n = 0.3; },  // never starts
      [](auto& p) { p.vehicle.initial_position_m = 2.0; },
      [](auto& p) { p.vehicle.viscous_friction_n_per_m_s = 1.0; },  // too fast for the switches
      [](auto& p) { p.track.position_m[1] = 0.02; },                // two switches at once
      [](auto& p) { p.track.switch_hysteresis_m = 0.0; },
      [](auto& p) { p.calibration[0].high_percent = 20.0; },
      [](auto& p) { p.uncertainty.noise_points = -1.0; },
      [](auto& p) { p.suction_percent = 0.0; },
  };
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    BenchParameters parameters;
    mistakes[i](parameters);
    const auto bench = TankBench::create(parameters);
    ASSERT_FALSE(bench) << "mistake " << i << " was accepted";
    EXPECT_EQ(bench.error().front().code, "C0321");
  }
}

TEST(BenchParameters, WhenSeveralFiguresAreWrong_ThenAllAreNamed) {
  BenchParameters parameters;
  parameters.density_kg_per_l = 0.0;
  parameters.pumps[3].lift_m = 0.0;
  const auto valid = validate(parameters);
  ASSERT_FALSE(valid);
  EXPECT_EQ(valid.error().size(), 2u);
}

}  // namespace
}  // namespace stepwright::assemblies

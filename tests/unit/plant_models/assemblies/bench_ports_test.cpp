#include "plant_models/assemblies/bench_ports.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/unit/plant_models/assemblies/bench_rig.h"

namespace stepwright::assemblies {
namespace {

TEST(BenchPorts, WhenListed_ThenNamesAreUnique) {
  std::set<std::string> names;
  for (const auto& port : bench_actuators()) EXPECT_TRUE(names.insert(port.name).second) << port.name;
  for (const auto& port : bench_sensors()) EXPECT_TRUE(names.insert(port.name).second) << port.name;
  names.clear();
  for (const auto& truth : bench_truths()) EXPECT_TRUE(names.insert(truth.name).second) << truth.name;
  for (const auto& fault : bench_faults()) EXPECT_TRUE(names.insert(fault.name).second) << fault.name;
}

TEST(BenchPorts, WhenSearchedByName_ThenCaseDoesNotMatter) {
  BenchRig rig;
  EXPECT_EQ(core::find_actuator(rig.plant(), "b2"), core::ActuatorId(1));
  EXPECT_EQ(core::find_sensor(rig.plant(), "FC3"), core::SensorId(2));
  EXPECT_FALSE(core::find_sensor(rig.plant(), "B1"));
  EXPECT_FALSE(core::find_truth(rig.plant(), "level"));
}

// A viewer looks live values up by the names of the description.
TEST(BenchPorts, WhenDescribed_ThenEveryNameExists) {
  BenchRig rig;
  const core::Plant& plant = rig.plant();
  const core::PlantDescription& d = plant.description();
  std::set<std::string> tanks, pumps;
  for (const auto& tank : d.tanks) {
    tanks.insert(tank.name);
    EXPECT_TRUE(core::find_truth(plant, tank.level_truth)) << tank.level_truth;
    EXPECT_TRUE(tank.sensor.empty() || core::find_sensor(plant, tank.sensor)) << tank.sensor;
  }
  for (const auto& pump : d.pumps) {
    pumps.insert(pump.name);
    EXPECT_TRUE(core::find_actuator(plant, pump.actuator));
    EXPECT_TRUE(core::find_truth(plant, pump.speed_truth));
    EXPECT_TRUE(core::find_truth(plant, pump.flow_truth));
  }
  for (const auto& pipe : d.pipes) {
    EXPECT_TRUE(tanks.contains(pipe.from) && tanks.contains(pipe.to));
    EXPECT_TRUE(pipe.pump.empty() || pumps.contains(pipe.pump));
  }
  ASSERT_EQ(d.vehicles.size(), 1u);
  EXPECT_TRUE(core::find_truth(plant, d.vehicles[0].position_truth));
  EXPECT_TRUE(core::find_actuator(plant, d.vehicles[0].drive_left));
  for (const auto& place : d.vehicles[0].places) EXPECT_TRUE(core::find_sensor(plant, place.switch_sensor));
  for (const auto& sensor : d.sensors) EXPECT_TRUE(core::find_truth(plant, sensor.measures));
  EXPECT_EQ(d.sensors.size(), kLevelSensors);
}

}  // namespace
}  // namespace stepwright::assemblies

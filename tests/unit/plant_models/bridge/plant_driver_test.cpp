#include "plant_models/bridge/plant_driver.h"

#include <gtest/gtest.h>

#include <array>

#include "plant_models/assemblies/robot_cell.h"
#include "plant_models/assemblies/tank_bench.h"
#include "plant_models/assemblies/tugger.h"
#include "tests/support/malloc_guard.h"

namespace stepwright::bridge {
namespace {

constexpr AreaSizes kSizes = {.input_bytes = 8, .output_bytes = 1};
constexpr std::int64_t kScanNs = 10'000'000;

std::unique_ptr<assemblies::TankBench> make_plant() {
  assemblies::BenchParameters parameters;
  parameters.uncertainty = assemblies::SensorUncertainty::none();
  return assemblies::TankBench::create(parameters).value();
}

int word(std::span<const std::byte> area, std::size_t index) {
  return static_cast<int>(area[2 * index]) | static_cast<int>(area[2 * index + 1]) << 8;
}

// A plant whose solver has given up.
class DeadPlant : public core::Plant {
 public:
  std::span<const core::Port> actuators() const override { return {}; }
  std::span<const core::Port> sensors() const override { return {}; }
  std::span<const core::Quantity> truths() const override { return {}; }
  std::span<const core::Quantity> faults() const override { return {}; }
  const core::PlantDescription& description() const override { return description_; }
  std::chrono::nanoseconds now() const override { return std::chrono::nanoseconds(0); }
  void set_actuator(core::ActuatorId, std::int16_t) override {}
  core::PlantStatus advance_to(std::chrono::nanoseconds) override { return core::PlantStatus::Failed; }
  std::int16_t sensor(core::SensorId) const override { return 0; }
  double truth(core::TruthId) const override { return 0.0; }
  result::Result<void> inject_fault(std::string_view, double) override { return {}; }
  result::Result<void> clear_fault(std::string_view) override { return {}; }
  std::size_t kept_size() const override { return 0; }
  void keep(std::span<double>) const override {}

 private:
  core::PlantDescription description_;
};

// One analogue actuator, which notes what it is told.
class SetpointPlant final : public DeadPlant {
 public:
  std::span<const core::Port> actuators() const override { return ports_; }
  void set_actuator(core::ActuatorId, std::int16_t value) override { told = value; }
  core::PlantStatus advance_to(std::chrono::nanoseconds) override { return core::PlantStatus::Good; }

  std::int16_t told = 0;

 private:
  std::array<core::Port, 1> ports_ = {core::Port{"speed", core::PortKind::Count, "set point in mm/s"}};
};

class PlantDriverTest : public testing::Test {
 protected:
  std::unique_ptr<assemblies::TankBench> plant = make_plant();
  std::array<std::byte, 8> inputs{};
  std::array<std::byte, 1> outputs{};

  // The codes that these wires are refused with.
  std::vector<std::string> codes(const std::vector<PortWire>& wires) {
    const auto driver = PlantDriver::create(*plant, wires, kSizes);
    std::vector<std::string> found;
    if (driver) return found;
    for (const auto& diagnostic : driver.error()) found.push_back(diagnostic.code);
    return found;
  }
};

TEST_F(PlantDriverTest, WhenReadAtTheStart_ThenSwitchesAndCountsStandAtTheirAddresses) {
  auto driver = PlantDriver::create(*plant, default_bench_wires(), kSizes).value();
  inputs[0] = std::byte{0x86};  // fc2 and fc3 must be cleared, bit 7 is nobody's
  ASSERT_EQ(driver.read_inputs(0, inputs), image::IoStatus::Good);
  EXPECT_EQ(inputs[0], std::byte{0x81});
  EXPECT_EQ(word(inputs, 1), 1322);
  EXPECT_EQ(word(inputs, 2), 736);
  EXPECT_EQ(word(inputs, 3), 1061);
}

TEST_F(PlantDriverTest, WhenOutputsAreWritten_ThenThePlantFollowsInLockStep) {
  auto driver = PlantDriver::create(*plant, default_bench_wires(), kSizes).value();
  for (int scan = 0; scan <= 200; ++scan) {
    ASSERT_EQ(driver.read_inputs(scan * kScanNs, inputs), image::IoStatus::Good);
    outputs[0] = std::byte{0x01};  // B1
    ASSERT_EQ(driver.write_outputs(scan * kScanNs, outputs), image::IoStatus::Good);
    ASSERT_EQ(plant->now().count(), scan * kScanNs);
  }
  EXPECT_GT(word(inputs, 1), 1600);
  EXPECT_GT(plant->truth(*core::find_truth(*plant, "flow_b1")), 0.2);
}

TEST_F(PlantDriverTest, WhenDriveBitsAreWritten_ThenTheVehicleMovesTheRightWay) {
  auto driver = PlantDriver::create(*plant, default_bench_wires(), kSizes).value();
  outputs[0] = std::byte{0x08};  // drive_right
  driver.write_outputs(0, outputs);
  driver.read_inputs(2'000'000'000, inputs);
  EXPECT_GT(plant->truth(*core::find_truth(*plant, "position")), 0.1);
  EXPECT_EQ(inputs[0], std::byte{0});
}

TEST_F(PlantDriverTest, WhenASetPointIsWritten_ThenThePlantGetsItsCountsWithTheirSign) {
  SetpointPlant plant_with_set_point;
  const std::vector<PortWire> wires = {{"speed", "%QW1", {}}};
  auto driver =
      PlantDriver::create(plant_with_set_point, wires, {.input_bytes = 0, .output_bytes = 4}).value();
  const std::array<std::byte, 4> backwards = {std::byte{0xFF}, std::byte{0xFF}, std::byte{0x18},
                                              std::byte{0xFC}};
  EXPECT_EQ(driver.write_outputs(0, backwards), image::IoStatus::Good);
  EXPECT_EQ(plant_with_set_point.told, -1000);
  const std::vector<PortWire> as_a_bit = {{"speed", "%QX1.0", {}}};
  EXPECT_EQ(PlantDriver::create(plant_with_set_point, as_a_bit, {0, 4}).error().front().code, "C0306");
}

TEST_F(PlantDriverTest, WhenAreaIsSmallerThanPromised_ThenLost) {
  auto driver = PlantDriver::create(*plant, default_bench_wires(), kSizes).value();
  EXPECT_EQ(driver.read_inputs(0, std::span(inputs).first(4)), image::IoStatus::Lost);
  EXPECT_EQ(driver.write_outputs(0, {}), image::IoStatus::Lost);
}

TEST_F(PlantDriverTest, WhenThePlantHasFailed_ThenLost) {
  DeadPlant dead;
  auto driver = PlantDriver::create(dead, {}, kSizes).value();
  EXPECT_EQ(driver.read_inputs(0, inputs), image::IoStatus::Lost);
  EXPECT_EQ(driver.write_outputs(0, outputs), image::IoStatus::Lost);
}

TEST_F(PlantDriverTest, WhenAWireIsWrong_ThenRefusedWithItsCode) {
  using Codes = std::vector<std::string>;
  EXPECT_EQ(codes({{"fc9", "%IX0.0", {}}}), Codes{"C0301"});
  EXPECT_EQ(codes({{"fc1", "%IX0.9", {}}}), Codes{"C0302"});
  EXPECT_EQ(codes({{"S3", "%IW4", {}}}), Codes{"C0303"});
  EXPECT_EQ(codes({{"B1", "%QX1.0", {}}}), Codes{"C0303"});
  EXPECT_EQ(codes({{"fc1", "%IX2.4", {}}, {"S1", "%IW1", {}}}), Codes{"C0304"});
  EXPECT_EQ(codes({{"fc1", "%IX0.0", {}}, {"FC1", "%IX0.1", {}}}), Codes{"C0305"});
  EXPECT_EQ(codes({{"fc1", "%QX0.0", {}}}), Codes{"C0306"});
  EXPECT_EQ(codes({{"S1", "%IX0.0", {}}}), Codes{"C0306"});
  EXPECT_EQ(codes({{"B1", "%QW0", {}}}), Codes{"C0306"});
}

TEST_F(PlantDriverTest, WhenSeveralWiresAreWrong_ThenEachIsNamedAtItsPlace) {
  const std::vector<PortWire> wires = {{"pump", "%QX0.0", {"cell.toml", 4, 1}},
                                       {"fc1", "%IX0.0", {"cell.toml", 5, 1}},
                                       {"S1", "IW1", {"cell.toml", 6, 1}}};
  const auto driver = PlantDriver::create(*plant, wires, kSizes);
  ASSERT_FALSE(driver);
  ASSERT_EQ(driver.error().size(), 2u);
  EXPECT_EQ(driver.error()[0].where.line, 4u);
  EXPECT_NE(driver.error()[0].hint.find("drive_left"), std::string::npos);
  EXPECT_EQ(driver.error()[1].where.line, 6u);
}

TEST(TuggerWires, WhenACellGivesNone_ThenEveryTerminalHasAPlaceOfItsOwn) {
  assemblies::TuggerParameters parameters;
  parameters.trailers = 2;
  parameters.most_trailers = 4;
  std::vector<std::string> names;
  for (int k = 0; k < 10; ++k) {
    names.push_back("p" + std::to_string(k));
    parameters.places.push_back({names.back(), {{0, 0}, {1, 0}, {1, 1}}});
  }
  const auto tugger = assemblies::Tugger::create(parameters).value();
  const auto wires = default_tugger_wires(4, names);
  EXPECT_EQ(wires.size(), tugger->sensors().size() + tugger->actuators().size());
  // 10 words, a byte of switches, two of places.
  auto driver = PlantDriver::create(*tugger, wires, {.input_bytes = 23, .output_bytes = 5});
  ASSERT_TRUE(driver) << result::to_string(driver.error());
  std::array<std::byte, 23> inputs{};
  driver->read_inputs(0, inputs);
  EXPECT_EQ(word(inputs, 9), 2);            // trailers
  EXPECT_EQ(inputs[20], std::byte{0b110});  // estop_ok and way_free
  EXPECT_EQ(wires[5 + 4 + 1 + 3 + 9].port, "at_p9");
  EXPECT_EQ(wires[5 + 4 + 1 + 3 + 9].address, "%IX22.1");
}

TEST(RobotCellWires, WhenACellGivesNone_ThenEveryTerminalHasAPlaceOfItsOwn) {
  assemblies::RobotCellParameters parameters;
  for (const char* name : {"left", "right"}) {
    parameters.arms.emplace_back();
    parameters.arms.back().name = name;
  }
  parameters.camera.slots = 4;
  const auto cell = assemblies::RobotCell::create(parameters).value();
  const std::vector<std::string> arms = {"left", "right"};
  const auto wires = default_robot_cell_wires(arms, 4);
  EXPECT_EQ(wires.size(), cell->sensors().size() + cell->actuators().size());
  auto driver = PlantDriver::create(*cell, wires, {.input_bytes = 79, .output_bytes = 35});
  ASSERT_TRUE(driver) << result::to_string(driver.error());
  std::array<std::byte, 79> inputs{};
  std::array<std::byte, 35> outputs{};
  outputs[33] = std::byte{1};  // enable_right
  driver->write_outputs(0, outputs);
  driver->read_inputs(0, inputs);
  EXPECT_EQ(word(inputs, 15), 900);     // width_right
  EXPECT_EQ(inputs[76], std::byte{0});  // ready_left
  EXPECT_EQ(inputs[77], std::byte{1});  // ready_right
  EXPECT_EQ(inputs[78], std::byte{1});  // estop_ok
}

TEST_F(PlantDriverTest, WhenScanning_ThenNothingIsAllocated) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns the allocator";
  auto driver = PlantDriver::create(*plant, default_bench_wires(), kSizes).value();
  const support::GuardCounts before = support::guard_counts();
  for (int scan = 0; scan < 5000; ++scan) {
    driver.read_inputs(scan * kScanNs, inputs);
    outputs[0] = static_cast<std::byte>(scan / 200 * 37 & 0x3F);
    driver.write_outputs(scan * kScanNs, outputs);
  }
  EXPECT_EQ(support::guard_counts(), before);
}

}  // namespace
}  // namespace stepwright::bridge

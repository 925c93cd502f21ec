#include "cell/modbus_client/field_outputs.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>
#include <thread>

#include "runtime/io_memory/memory_driver.h"

namespace stepwright::modbus_client {
namespace {

using namespace std::chrono_literals;
using io_memory::PlantSide;

// Byte 0: killed 9, lost I/O 7; byte 1 is held; the rest goes to zero.
class FieldOutputsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    name_ = "field-" + std::to_string(getpid());
    for (const auto cause : {scan::SafeCause::Killed, scan::SafeCause::IoLost}) {
      auto& rules = rules_[static_cast<std::size_t>(cause)];
      rules = {{{0, 0xFF, scan::SafeMode::Value,
                 static_cast<std::uint8_t>(cause == scan::SafeCause::Killed ? 9 : 7)},
                {1, 0xFF, scan::SafeMode::Hold, 0}}};
      matrix_[static_cast<std::size_t>(cause)].outputs = rules;
    }
    auto plant = PlantSide::open(name_, 8, 8);
    ASSERT_TRUE(plant);
    plant_ = std::move(*plant);
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove(io_memory::area_path(name_), ignored);
  }
  std::unique_ptr<io_memory::MemoryDriver> runtime() {
    auto area = io_memory::IoArea::open(name_, 8, 8);
    EXPECT_TRUE(area);
    return std::make_unique<io_memory::MemoryDriver>(std::move(*area));
  }
  void drive(io_memory::MemoryDriver& driver, int value) {
    std::array<std::byte, 8> outputs{};
    outputs.fill(static_cast<std::byte>(value));
    EXPECT_EQ(driver.write_outputs(0, outputs), image::IoStatus::Good);
    driver.beat();
  }
  int byte(FieldOutputs& field, std::size_t at) {
    const auto outputs = field.turn(*plant_);
    return outputs ? std::to_integer<int>((*outputs)[at]) : -1;
  }

  std::string name_;
  std::array<std::array<scan::SafeOutput, 2>, scan::kSafeCauses> rules_{};
  scan::SafeMatrix matrix_{};
  std::unique_ptr<PlantSide> plant_;
};

TEST_F(FieldOutputsTest, WhenNobodyEverDrove_ThenTheDevicesKeepWhatTheyHave) {
  FieldOutputs field(matrix_, 8, 50ms);
  EXPECT_EQ(byte(field, 0), -1);
  EXPECT_FALSE(field.last());
}

TEST_F(FieldOutputsTest, WhenTheRuntimeDrives_ThenItsOutputsHold) {
  FieldOutputs field(matrix_, 8, 10s);
  const auto driver = runtime();
  drive(*driver, 5);
  EXPECT_EQ(byte(field, 0), 5);
  drive(*driver, 6);
  EXPECT_EQ(byte(field, 0), 6);
  EXPECT_FALSE(field.deserted());
}

TEST_F(FieldOutputsTest, WhenNobodyIsHeardOf_ThenTheOutputsAreSafeUntilSomebodyIs) {
  FieldOutputs field(matrix_, 8, 50ms);
  const auto driver = runtime();
  drive(*driver, 5);
  EXPECT_EQ(byte(field, 0), 5);
  std::this_thread::sleep_for(80ms);
  EXPECT_EQ(byte(field, 0), 9);
  EXPECT_EQ(byte(field, 1), 5);
  EXPECT_EQ(byte(field, 2), 0);
  EXPECT_TRUE(field.deserted());
  drive(*driver, 4);
  EXPECT_EQ(byte(field, 0), 4);
  EXPECT_FALSE(field.deserted());
}

TEST_F(FieldOutputsTest, WhenTheRuntimeEndsInGoodOrder_ThenItsLastOutputsStay) {
  FieldOutputs field(matrix_, 8, 50ms);
  auto driver = runtime();
  drive(*driver, 5);
  driver.reset();
  std::this_thread::sleep_for(80ms);
  EXPECT_EQ(byte(field, 0), 5);
}

TEST_F(FieldOutputsTest, WhenTheClientEnds_ThenTheOutputsAreThoseOfLostIo) {
  FieldOutputs field(matrix_, 8, 10s);
  const auto driver = runtime();
  drive(*driver, 5);
  EXPECT_EQ(byte(field, 0), 5);
  const auto last = field.last();
  ASSERT_TRUE(last);
  EXPECT_EQ(std::to_integer<int>((*last)[0]), 7);
  EXPECT_EQ(std::to_integer<int>((*last)[1]), 5);
}

// The plant's word for "I am here, my devices are not".
TEST_F(FieldOutputsTest, WhenThePlantGivesUp_ThenTheRuntimeKnowsAtOnce) {
  auto area = io_memory::IoArea::open(name_, 8, 8);
  ASSERT_TRUE(area);
  io_memory::MemoryDriver driver(std::move(*area), io_memory::PlantNeed::Always);
  std::array<std::byte, 8> inputs{};
  EXPECT_EQ(driver.read_inputs(0, inputs), image::IoStatus::Lost) << "nobody has announced anything";
  plant_->announce(1'000'000'000);
  EXPECT_EQ(driver.read_inputs(0, inputs), image::IoStatus::Good);
  std::array<std::byte, 8> left{};
  left[3] = std::byte{33};
  plant_->lose(left);
  EXPECT_EQ(driver.read_inputs(0, inputs), image::IoStatus::Lost);
  EXPECT_EQ(inputs[3], std::byte{33}) << "what is still known is told";
  plant_->write_inputs(left);
  EXPECT_EQ(driver.read_inputs(0, inputs), image::IoStatus::Good);
}

}  // namespace
}  // namespace stepwright::modbus_client

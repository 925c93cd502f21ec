#include "plant_models/stepped/step_area.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstring>

namespace stepwright::stepped {
namespace {

const StepNames kNames = {{"valve", "drain"}, {"level of the tank"}, {"volume"}, {"leak"}};

// A file in memory with these bytes.
class Memory {
 public:
  explicit Memory(std::size_t bytes) : descriptor_(memfd_create("test", 0)) {
    EXPECT_EQ(ftruncate(descriptor_, static_cast<off_t>(bytes)), 0);
  }
  ~Memory() { close(descriptor_); }
  int descriptor() const { return descriptor_; }
  void write(const StepHeader& header) const {
    EXPECT_EQ(pwrite(descriptor_, &header, sizeof header, 0), static_cast<ssize_t>(sizeof header));
  }

 private:
  int descriptor_;
};

void set_plain(StepHeader& header, std::uint32_t bytes) {
  header.magic = kStepMagic;
  header.version = kStepVersion;
  header.area_bytes = bytes;
  for (BlockPlace* place :
       {&header.actuators, &header.sensors, &header.values, &header.faults, &header.names})
    *place = {1, 448};
}

std::string refusal(const StepHeader& header, std::size_t bytes) {
  const Memory memory(bytes);
  memory.write(header);
  auto area = StepArea::attach(memory.descriptor());
  return area ? "none" : area.error().front().code + " " + area.error().front().message;
}

TEST(StepArea, WhenBothSidesHaveIt_ThenEachSeesTheOthersNumbersAndNames) {
  auto runtime = StepArea::make(kNames, 7).value();
  auto plant = StepArea::attach(runtime.descriptor()).value();
  EXPECT_EQ(plant.header().seed, 7u);
  EXPECT_EQ(plant.names().actuators, kNames.actuators);
  EXPECT_EQ(plant.names().sensors, kNames.sensors);
  EXPECT_EQ(plant.names().faults, kNames.faults);
  runtime.set_actuator(1, 2.5);
  plant.set_sensor(0, -1.0);
  plant.set_value(0, 3.0);
  runtime.set_fault(0, 0.25);
  EXPECT_EQ(plant.actuator(1), 2.5);
  EXPECT_EQ(plant.actuator(0), 0.0);
  EXPECT_EQ(runtime.sensor(0), -1.0);
  EXPECT_EQ(runtime.value(0), 3.0);
  EXPECT_EQ(plant.fault(0), 0.25);
}

TEST(StepArea, WhenItIsMade_ThenNobodyCanChangeItsSize) {
  auto area = StepArea::make(kNames, 1).value();
  EXPECT_NE(ftruncate(area.descriptor(), 64), 0);
  EXPECT_NE(ftruncate(area.descriptor(), 1 << 20), 0);
}

TEST(StepArea, WhenItIsNoAreaOfThisVersion_ThenItSaysWhatIsWrong) {
  StepHeader header{};
  set_plain(header, 512);
  EXPECT_EQ(refusal(header, 512), "none");
  header.version = 9;
  EXPECT_NE(refusal(header, 512).find("version 9"), std::string::npos);
  set_plain(header, 512);
  header.magic = 1;
  EXPECT_NE(refusal(header, 512).find("SWPLANT1"), std::string::npos);
}

TEST(StepArea, WhenItIsSmallerThanItsHeaderSays_ThenItIsRefused) {
  StepHeader header{};
  set_plain(header, 4096);
  EXPECT_NE(refusal(header, 512).find("its header says 4096"), std::string::npos);
  const Memory tiny(100);
  const auto area = StepArea::attach(tiny.descriptor());
  ASSERT_FALSE(area);
  EXPECT_NE(area.error().front().message.find("100 bytes"), std::string::npos);
  EXPECT_FALSE(StepArea::attach(-1));
}

TEST(StepArea, WhenABlockLiesOutside_ThenItIsRefused) {
  for (const BlockPlace wrong :
       {BlockPlace{100, 448}, BlockPlace{1, 4096}, BlockPlace{1, 8}, BlockPlace{1, 449},
        BlockPlace{0xFFFFFFFF, 448}, BlockPlace{1, 0xFFFFFFF8}}) {
    StepHeader header{};
    set_plain(header, 512);
    header.sensors = wrong;
    EXPECT_NE(refusal(header, 512).find("outside"), std::string::npos) << wrong.count << " at " << wrong.at;
  }
}

TEST(StepArea, WhenTheMessageHasNoEndAndNoText_ThenItIsReadWithinItsPlace) {
  auto area = StepArea::make(kNames, 1).value();
  std::memset(area.header().message, '\n', kMessageBytes);
  EXPECT_EQ(area.message(), std::string(kMessageBytes, ' '));
  area.set_message(std::string(1000, 'a'));
  EXPECT_EQ(area.message(), std::string(kMessageBytes - 1, 'a'));
}

}  // namespace
}  // namespace stepwright::stepped

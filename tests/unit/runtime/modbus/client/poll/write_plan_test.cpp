#include "runtime/modbus/client/poll/write_plan.h"

#include <gtest/gtest.h>

#include "runtime/modbus/client/poll/conversion.h"

namespace stepwright::modbus::client {
namespace {

using namespace std::chrono_literals;
using Clock = WritePlan::Clock;

Tag out(std::uint16_t first, std::uint32_t byte) {
  Tag tag;
  tag.first = first;
  tag.field = {byte, 0, ImageType::Uint};
  return tag;
}
Tag out_bit(std::uint16_t first, std::uint8_t bit, std::uint8_t image_bit) {
  Tag tag;
  tag.first = first;
  tag.bit = bit;
  tag.wire = WireType::Bool;
  tag.field = {0, image_bit, ImageType::Bool};
  return tag;
}

Device device_of(std::vector<Tag> outputs, WriteMode mode = WriteMode::Change) {
  Device device;
  Group group;
  group.write = mode;
  group.outputs = std::move(outputs);
  device.groups.push_back(group);
  return device;
}

class Bench {
 public:
  explicit Bench(const Device& device) : plan(device) {}
  void set(std::uint32_t byte, std::uint16_t value) {
    put_field(area, {byte, 0, ImageType::Uint}, value);
    plan.set_outputs(area);
  }
  // All that is due, acknowledged.
  std::vector<WriteRequest> flush() {
    std::vector<WriteRequest> sent;
    while (auto request = plan.next(now)) {
      plan.done(*request, true, now);
      sent.push_back(*request);
    }
    return sent;
  }
  WritePlan plan;
  std::vector<std::byte> area = std::vector<std::byte>(16);
  Clock::time_point now = Clock::now();
};

TEST(WritePlan, WhenNobodyHasSetOutputs_ThenNothingIsWritten) {
  Bench bench(device_of({out(5, 0)}));
  EXPECT_FALSE(bench.plan.next(bench.now));
  EXPECT_FALSE(bench.plan.due());
  EXPECT_TRUE(bench.plan.clean());
}

TEST(WritePlan, WhenOneValueChanges_ThenOnlyThatIsWritten) {
  Bench bench(device_of({out(5, 0), out(6, 2), out(7, 4)}));
  bench.set(0, 1);
  const auto first = bench.flush();
  ASSERT_EQ(first.size(), 1u);  // neighbours in one request
  EXPECT_EQ(first[0].words, (std::vector<std::uint16_t>{1, 0, 0}));
  EXPECT_TRUE(bench.plan.clean());
  bench.set(2, 9);
  EXPECT_FALSE(bench.plan.clean());
  const auto second = bench.flush();
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].first, 6);
  EXPECT_EQ(second[0].words, (std::vector<std::uint16_t>{9}));
  bench.set(2, 9);
  EXPECT_TRUE(bench.flush().empty());
}

TEST(WritePlan, WhenRegistersOfNobodyLieBetween_ThenTheyAreNotTouched) {
  Bench bench(device_of({out(5, 0), out(7, 2)}));
  bench.set(0, 1);
  EXPECT_EQ(bench.flush().size(), 2u);
}

TEST(WritePlan, WhenTheRefreshIsOver_ThenItIsWrittenAgain) {
  Device device = device_of({out(5, 0)});
  device.refresh = 1'000ms;
  Bench bench(device);
  bench.set(0, 1);
  bench.flush();
  ASSERT_TRUE(bench.plan.due());
  EXPECT_EQ(*bench.plan.due(), bench.now + 1'000ms);
  bench.now += 999ms;
  EXPECT_TRUE(bench.flush().empty());
  bench.now += 1ms;
  EXPECT_EQ(bench.flush().size(), 1u);
  device.refresh = 0ms;
  Bench never(device);
  never.set(0, 1);
  never.flush();
  EXPECT_FALSE(never.plan.due());
}

TEST(WritePlan, WhenTheGroupIsCyclic_ThenEveryPeriodWrites) {
  Device device = device_of({out(5, 0)}, WriteMode::Cyclic);
  device.groups[0].period = 50ms;
  Bench bench(device);
  bench.set(0, 1);
  bench.flush();
  bench.now += 49ms;
  EXPECT_TRUE(bench.flush().empty());
  bench.now += 1ms;
  EXPECT_EQ(bench.flush().size(), 1u);
}

TEST(WritePlan, WhenTheConnectionWasLost_ThenAllIsWrittenAgain) {
  Bench bench(device_of({out(5, 0), out(9, 2)}));
  bench.set(0, 1);
  bench.flush();
  bench.plan.forget();
  EXPECT_EQ(bench.flush().size(), 2u);
}

TEST(WritePlan, WhenTheSlaveRefuses_ThenItIsLeftAloneForAWhile) {
  Bench bench(device_of({out(5, 0), out(9, 2)}));
  bench.set(0, 1);
  const auto request = bench.plan.next(bench.now);
  ASSERT_TRUE(request);
  bench.plan.done(*request, false, bench.now);
  const auto other = bench.flush();  // the others go on
  ASSERT_EQ(other.size(), 1u);
  EXPECT_NE(other[0].first, request->first);
  EXPECT_FALSE(bench.plan.clean());
  bench.now += 500ms;
  EXPECT_EQ(bench.flush().size(), 1u);
  EXPECT_TRUE(bench.plan.clean());
}

TEST(WritePlan, WhenBitsOfARegisterAreWritten_ThenTheOthersAreMaskedOut) {
  Device device = device_of({out_bit(5, 0, 0), out_bit(5, 12, 1), out(6, 2)});
  Bench bench(device);
  bench.area[0] = std::byte{0b10};
  bench.set(2, 7);
  const auto masked = bench.flush();
  ASSERT_EQ(masked.size(), 2u);
  EXPECT_EQ(masked[0].mask, 0x1001);
  EXPECT_EQ(masked[0].words, (std::vector<std::uint16_t>{0x1000}));
  EXPECT_EQ(bench.plan.tags_of(masked[0]), (std::vector<std::uint32_t>{0, 1}));
  device.mask_writes = false;
  Bench whole(device);
  whole.area[0] = std::byte{0b11};
  whole.set(2, 7);
  const auto once = whole.flush();
  ASSERT_EQ(once.size(), 1u);
  EXPECT_EQ(once[0].mask, 0);
  EXPECT_EQ(once[0].words, (std::vector<std::uint16_t>{0x1001, 7}));
}

TEST(WritePlan, WhenMoreIsDueThanARequestHolds_ThenThereAreSeveral) {
  std::vector<Tag> tags;
  for (std::uint16_t i = 0; i < 130; ++i) tags.push_back(out(i, 0));
  Bench bench(device_of(std::move(tags)));
  bench.set(0, 3);
  const auto sent = bench.flush();
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[0].words.size(), 123u);
  EXPECT_EQ(sent[1].words.size(), 7u);
}

}  // namespace
}  // namespace stepwright::modbus::client

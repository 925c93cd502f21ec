#include "runtime/modbus/client/poll/tag_cache.h"

#include <gtest/gtest.h>

#include "runtime/modbus/client/poll/conversion.h"

namespace stepwright::modbus::client {
namespace {

using namespace std::chrono_literals;

// One device with an INT at %IW0 (quality %IB4, age %IW3) and an output; online at %IX5.0.
Device device_of(LossValue on_loss, OnLoss policy = OnLoss::Safe) {
  Device device;
  device.name = "press";
  device.on_loss = policy;
  device.online_bit = 40;
  Group group;
  Tag in;
  in.field = {0, 0, ImageType::Uint};
  in.on_loss = on_loss;
  in.loss_value = 77;
  in.quality_byte = 4;
  in.age = ImageField{6, 0, ImageType::Uint};
  group.inputs.push_back(in);
  Tag out;
  out.field = {0, 0, ImageType::Uint};
  group.outputs.push_back(out);
  device.groups.push_back(group);
  return device;
}

class CachedTag {
 public:
  explicit CachedTag(const Device& device) : cache({device}, start) {}
  std::uint64_t value() { return field({0, 0, ImageType::Uint}); }
  Quality quality() { return static_cast<Quality>(field({4, 0, ImageType::Usint})); }
  std::uint64_t age() { return field({6, 0, ImageType::Uint}); }
  bool online() { return field({5, 0, ImageType::Bool}) != 0; }
  void read(std::uint16_t word) {
    cache.read(0, kRequest, std::array{word}, start + at);
    cache.online(0, start + at);
  }
  void fail(Quality why) { cache.not_read(0, kRequest.tags, why, "told"); }
  bool lost() { return cache.lost(start + at); }

  static inline const ReadRequest kRequest{Table::HoldingRegisters, 0, 1, {0}};
  TagCache::Clock::time_point start = TagCache::Clock::now();
  std::chrono::milliseconds at{0};
  TagCache cache;

 private:
  std::uint64_t field(const ImageField& where) {
    std::vector<std::byte> area(16);
    cache.collect(start + at, area);
    return get_field(area, where);
  }
};

TEST(TagCache, WhenNothingWasReadYet_ThenTheValueIsBadAndTheProgramMustNotDrive) {
  CachedTag tag(device_of(LossValue::Value));
  EXPECT_EQ(tag.quality(), Quality::NotConnected);
  EXPECT_EQ(tag.value(), 77u);
  EXPECT_EQ(tag.age(), 65'535u);
  EXPECT_TRUE(tag.lost());
  EXPECT_FALSE(tag.online());
}

// On a busy machine the value may come between somebody's look at the clock and his question.
TEST(TagCache, WhenAValueCameAfterTheLookAtTheClock_ThenItIsNew) {
  CachedTag tag(device_of(LossValue::Value));
  tag.at = 20ms;
  tag.read(5);
  tag.at = 10ms;
  EXPECT_EQ(tag.age(), 0u) << "and not as if it had never come";
  std::vector<DeviceStatus> told;
  tag.cache.report(tag.start + tag.at, told);
  EXPECT_EQ(told.front().tags.front().age_ms, 0);
  EXPECT_EQ(told.front().tags.front().quality, Quality::Good);
}

TEST(TagCache, WhenReadsFail_ThenTheValueIsUncertainThenBad) {
  CachedTag tag(device_of(LossValue::Value));
  tag.read(5);
  EXPECT_EQ(tag.quality(), Quality::Good);
  EXPECT_EQ(tag.value(), 5u);
  EXPECT_TRUE(tag.online());
  EXPECT_FALSE(tag.lost());
  tag.at = 300ms;
  tag.fail(Quality::CommFailure);
  EXPECT_EQ(tag.quality(), Quality::LastUsable);
  EXPECT_EQ(tag.value(), 5u);
  EXPECT_EQ(tag.age(), 300u);
  EXPECT_FALSE(tag.lost());
  tag.at = 1'001ms;
  EXPECT_EQ(tag.quality(), Quality::CommFailure);
  EXPECT_EQ(tag.value(), 77u);
  EXPECT_TRUE(tag.lost());
  tag.fail(Quality::DeviceFailure);
  EXPECT_EQ(tag.quality(), Quality::DeviceFailure);
  tag.read(6);
  EXPECT_EQ(tag.quality(), Quality::Good);
  EXPECT_EQ(tag.value(), 6u);
  EXPECT_FALSE(tag.lost());
}

TEST(TagCache, WhenAValueIsLost_ThenItIsWhatIsSaidAboutIt) {
  for (const auto& [on_loss, value] :
       {std::pair{LossValue::Hold, 5u}, {LossValue::Zero, 0u}, {LossValue::Value, 77u}}) {
    CachedTag tag(device_of(on_loss));
    tag.read(5);
    tag.at = 1'001ms;
    EXPECT_EQ(tag.value(), value);
  }
}

// The poller may be late without a fault: that is no news either.
TEST(TagCache, WhenNobodyReads_ThenTheValueGetsOldAllTheSame) {
  CachedTag tag(device_of(LossValue::Hold));
  tag.read(5);
  tag.at = 1'001ms;
  EXPECT_EQ(tag.quality(), Quality::CommFailure);
  EXPECT_TRUE(tag.lost());
}

TEST(TagCache, WhenTheGroupIsSlow_ThenTwoOfItsPeriodsAreAllowed) {
  Device device = device_of(LossValue::Hold);
  device.groups[0].period = 3s;
  CachedTag tag(device);
  tag.read(5);
  tag.at = 5'999ms;
  EXPECT_EQ(tag.quality(), Quality::Good);
  tag.at = 6'001ms;
  EXPECT_EQ(tag.quality(), Quality::CommFailure);
}

TEST(TagCache, WhenTheProgramGoesOnWithoutTheDevice_ThenNothingIsLost) {
  CachedTag tag(device_of(LossValue::Hold, OnLoss::Carry));
  EXPECT_FALSE(tag.lost());
}

TEST(TagCache, WhenAnOutputIsNotAcknowledged_ThenTheIoIsLostInTime) {
  CachedTag tag(device_of(LossValue::Hold));
  const std::array<std::uint32_t, 1> outputs{0};
  tag.read(5);
  tag.cache.not_written(0, outputs, Quality::DeviceFailure, "told", tag.start + 100ms);
  tag.at = 900ms;
  tag.read(5);
  EXPECT_FALSE(tag.lost());
  tag.at = 1'101ms;
  EXPECT_TRUE(tag.lost());
  const std::array<std::uint8_t, 1> exact{0};
  tag.cache.written(0, outputs, exact, tag.start + tag.at);
  EXPECT_FALSE(tag.lost());
}

TEST(TagCache, WhenADeviceComesAndGoes_ThenItIsToldOnce) {
  CachedTag tag(device_of(LossValue::Hold));
  tag.cache.offline(0, Quality::NotConnected, "refused", tag.start);
  tag.cache.offline(0, Quality::NotConnected, "refused", tag.start);
  tag.cache.online(0, tag.start);
  tag.cache.online(0, tag.start);
  const auto news = tag.cache.take_news();
  ASSERT_EQ(news.size(), 2u);
  EXPECT_FALSE(news[0].online);
  EXPECT_EQ(news[0].reason, "refused");
  EXPECT_TRUE(news[1].online);
  EXPECT_TRUE(tag.cache.take_news().empty());
}

TEST(TagCache, WhenTheNumberIsOutOfRange_ThenTheQualitySaysSoAndNanKeepsTheValueBefore) {
  Device device = device_of(LossValue::Hold);
  device.groups[0].inputs[0].wire = WireType::Real;
  CachedTag tag(device);
  const ReadRequest request{Table::HoldingRegisters, 0, 2, {0}};
  tag.cache.read(0, request, std::array<std::uint16_t, 2>{0x4120, 0}, tag.start);  // 10.0
  EXPECT_EQ(tag.value(), 10u);
  tag.cache.read(0, request, std::array<std::uint16_t, 2>{0x7FC0, 0}, tag.start);
  EXPECT_EQ(tag.value(), 10u);
  EXPECT_EQ(tag.quality(), Quality::RangeExceeded);
}

}  // namespace
}  // namespace stepwright::modbus::client

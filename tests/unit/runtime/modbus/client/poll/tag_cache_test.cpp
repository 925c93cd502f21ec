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

class Board {
 public:
  explicit Board(const Device& device) : board({device}, start) {}
  std::uint64_t value() { return field({0, 0, ImageType::Uint}); }
  Quality quality() { return static_cast<Quality>(field({4, 0, ImageType::Usint})); }
  std::uint64_t age() { return field({6, 0, ImageType::Uint}); }
  bool online() { return field({5, 0, ImageType::Bool}) != 0; }
  void read(std::uint16_t word) {
    board.read(0, kRequest, std::array{word}, start + at);
    board.online(0, start + at);
  }
  void fail(Quality why) { board.not_read(0, kRequest.tags, why, "told"); }
  bool lost() { return board.lost(start + at); }

  static inline const ReadRequest kRequest{Table::HoldingRegisters, 0, 1, {0}};
  TagBoard::Clock::time_point start = TagBoard::Clock::now();
  std::chrono::milliseconds at{0};
  TagBoard board;

 private:
  std::uint64_t field(const ImageField& where) {
    std::vector<std::byte> area(16);
    board.collect(start + at, area);
    return get_field(area, where);
  }
};

TEST(TagBoard, WhenNothingWasReadYet_ThenTheValueIsBadAndTheProgramMustNotDrive) {
  Board board(device_of(LossValue::Value));
  EXPECT_EQ(board.quality(), Quality::NotConnected);
  EXPECT_EQ(board.value(), 77u);
  EXPECT_EQ(board.age(), 65'535u);
  EXPECT_TRUE(board.lost());
  EXPECT_FALSE(board.online());
}

TEST(TagBoard, WhenReadsFail_ThenTheValueIsUncertainThenBad) {
  Board board(device_of(LossValue::Value));
  board.read(5);
  EXPECT_EQ(board.quality(), Quality::Good);
  EXPECT_EQ(board.value(), 5u);
  EXPECT_TRUE(board.online());
  EXPECT_FALSE(board.lost());
  board.at = 300ms;
  board.fail(Quality::CommFailure);
  EXPECT_EQ(board.quality(), Quality::LastUsable);
  EXPECT_EQ(board.value(), 5u);
  EXPECT_EQ(board.age(), 300u);
  EXPECT_FALSE(board.lost());
  board.at = 1'001ms;
  EXPECT_EQ(board.quality(), Quality::CommFailure);
  EXPECT_EQ(board.value(), 77u);
  EXPECT_TRUE(board.lost());
  board.fail(Quality::DeviceFailure);
  EXPECT_EQ(board.quality(), Quality::DeviceFailure);
  board.read(6);
  EXPECT_EQ(board.quality(), Quality::Good);
  EXPECT_EQ(board.value(), 6u);
  EXPECT_FALSE(board.lost());
}

TEST(TagBoard, WhenAValueIsLost_ThenItIsWhatIsSaidAboutIt) {
  for (const auto& [on_loss, value] :
       {std::pair{LossValue::Hold, 5u}, {LossValue::Zero, 0u}, {LossValue::Value, 77u}}) {
    Board board(device_of(on_loss));
    board.read(5);
    board.at = 1'001ms;
    EXPECT_EQ(board.value(), value);
  }
}

// The poller may be late without a fault: that is no news either.
TEST(TagBoard, WhenNobodyReads_ThenTheValueGetsOldAllTheSame) {
  Board board(device_of(LossValue::Hold));
  board.read(5);
  board.at = 1'001ms;
  EXPECT_EQ(board.quality(), Quality::CommFailure);
  EXPECT_TRUE(board.lost());
}

TEST(TagBoard, WhenTheGroupIsSlow_ThenTwoOfItsPeriodsAreAllowed) {
  Device device = device_of(LossValue::Hold);
  device.groups[0].period = 3s;
  Board board(device);
  board.read(5);
  board.at = 5'999ms;
  EXPECT_EQ(board.quality(), Quality::Good);
  board.at = 6'001ms;
  EXPECT_EQ(board.quality(), Quality::CommFailure);
}

TEST(TagBoard, WhenTheProgramGoesOnWithoutTheDevice_ThenNothingIsLost) {
  Board board(device_of(LossValue::Hold, OnLoss::Carry));
  EXPECT_FALSE(board.lost());
}

TEST(TagBoard, WhenAnOutputIsNotAcknowledged_ThenTheIoIsLostInTime) {
  Board board(device_of(LossValue::Hold));
  const std::array<std::uint32_t, 1> outputs{0};
  board.read(5);
  board.board.not_written(0, outputs, Quality::DeviceFailure, "told", board.start + 100ms);
  board.at = 900ms;
  board.read(5);
  EXPECT_FALSE(board.lost());
  board.at = 1'101ms;
  EXPECT_TRUE(board.lost());
  const std::array<std::uint8_t, 1> exact{0};
  board.board.written(0, outputs, exact, board.start + board.at);
  EXPECT_FALSE(board.lost());
}

TEST(TagBoard, WhenADeviceComesAndGoes_ThenItIsToldOnce) {
  Board board(device_of(LossValue::Hold));
  board.board.offline(0, Quality::NotConnected, "refused", board.start);
  board.board.offline(0, Quality::NotConnected, "refused", board.start);
  board.board.online(0, board.start);
  board.board.online(0, board.start);
  const auto news = board.board.take_news();
  ASSERT_EQ(news.size(), 2u);
  EXPECT_FALSE(news[0].online);
  EXPECT_EQ(news[0].reason, "refused");
  EXPECT_TRUE(news[1].online);
  EXPECT_TRUE(board.board.take_news().empty());
}

TEST(TagBoard, WhenTheNumberIsOutOfRange_ThenTheQualitySaysSoAndNanKeepsTheValueBefore) {
  Device device = device_of(LossValue::Hold);
  device.groups[0].inputs[0].wire = WireType::Real;
  Board board(device);
  const ReadRequest request{Table::HoldingRegisters, 0, 2, {0}};
  board.board.read(0, request, std::array<std::uint16_t, 2>{0x4120, 0}, board.start);  // 10.0
  EXPECT_EQ(board.value(), 10u);
  board.board.read(0, request, std::array<std::uint16_t, 2>{0x7FC0, 0}, board.start);
  EXPECT_EQ(board.value(), 10u);
  EXPECT_EQ(board.quality(), Quality::RangeExceeded);
}

}  // namespace
}  // namespace stepwright::modbus::client

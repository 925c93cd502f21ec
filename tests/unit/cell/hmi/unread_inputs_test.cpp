#include "cell/hmi/unread_inputs.h"

#include <gtest/gtest.h>

namespace stepwright::hmi {
namespace {

modbus::client::Device device(const char* name, const char* input) {
  modbus::client::Device one;
  one.name = name;
  one.groups.resize(1);
  one.groups[0].inputs.resize(1);
  one.groups[0].inputs[0].address = input;
  one.groups[0].outputs.resize(1);
  one.groups[0].outputs[0].address = "%QW0";
  return one;
}

dds::DeviceHealth health_of(const char* name) {
  dds::DeviceHealth health;
  health.name = name;
  health.online = true;
  health.answer_age_ms = 20;
  return health;
}

class UnreadInputsTest : public testing::Test {
 protected:
  UnreadInputsTest() {
    settings_.devices = {device("tank", "%ID0"), device("drive", "%IW4")};
    health_.devices_known = true;
    health_.devices = {health_of("tank"), health_of("drive")};
  }
  // The bytes at which they begin.
  std::vector<std::uint32_t> unread(const std::optional<dds::RuntimeHealth>& health) const {
    std::vector<std::uint32_t> bytes;
    for (const server::UnreadInputs& device : unread_inputs(settings_, health))
      for (const reader::Variable& each : device.inputs) bytes.push_back(each.address);
    return bytes;
  }

  modbus::client::ClientSettings settings_;
  dds::RuntimeHealth health_;
};

using Bytes = std::vector<std::uint32_t>;

TEST_F(UnreadInputsTest, WhenAllDevicesAnswer_ThenAllInputsAreRead) {
  EXPECT_EQ(unread(health_), Bytes{});
}

TEST_F(UnreadInputsTest, WhenADeviceIsLostOrHasNeverAnswered_ThenItsInputsAreNot) {
  health_.devices[1].lost = true;
  EXPECT_EQ(unread(health_), (Bytes{8}));
  health_.devices[1].lost = false;
  health_.devices[0].answer_age_ms = -1;
  EXPECT_EQ(unread(health_), (Bytes{0}));
}

TEST_F(UnreadInputsTest, WhenADeviceDoesNotAnswer_ThenItIsNamedWithTheReason) {
  health_.devices[0].lost = true;
  health_.devices[0].answer_age_ms = -1;
  health_.devices[1].lost = true;
  const auto unread = unread_inputs(settings_, health_);
  ASSERT_EQ(unread.size(), 2u);
  EXPECT_EQ(unread[0].device, "tank");
  EXPECT_EQ(unread[0].why, protocol::Unread::Never) << "lost from the start is not read, rather than old";
  EXPECT_EQ(unread[1].device, "drive");
  EXPECT_EQ(unread[1].why, protocol::Unread::Lost);
  EXPECT_EQ(unread_inputs(settings_, std::nullopt).at(0).why, protocol::Unread::Untold);
}

TEST_F(UnreadInputsTest, WhenAnInputHasAValueForTheLoss_ThenThatCounts) {
  health_.devices[1].lost = true;
  settings_.devices[1].groups[0].inputs[0].on_loss = modbus::client::LossValue::Value;
  EXPECT_EQ(unread(health_), Bytes{});
}

TEST_F(UnreadInputsTest, WhenNobodySaysHowTheDevicesAre_ThenNothingIsRead) {
  EXPECT_EQ(unread(std::nullopt), (Bytes{0, 8}));
  health_.devices_known = false;
  EXPECT_EQ(unread(health_), (Bytes{0, 8}));
  health_.devices_known = true;
  health_.devices.pop_back();
  EXPECT_EQ(unread(health_), (Bytes{8}));
}

}  // namespace
}  // namespace stepwright::hmi

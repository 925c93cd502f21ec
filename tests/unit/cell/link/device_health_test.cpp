#include "cell/link/device_health.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cell/modbus_client/status_json.h"

namespace stepwright::link {
namespace {

using modbus::client::DeviceStatus;
using nlohmann::json;

DeviceStatus valves() {
  DeviceStatus device;
  device.name = "valves";
  device.endpoint = "10.0.0.2:502";
  device.unit = 7;
  device.online = true;
  device.error = "timed out";
  device.counters.requests = 12;
  device.counters.timeouts = 3;
  device.counters.answer.record(2'000'000);
  device.tags.resize(3);
  device.tags[0].age_ms = 80;
  device.tags[1].age_ms = 30;
  device.tags[2].age_ms = -1;
  return device;
}

TEST(DeviceHealth, WhenAModbusClientTells_ThenItIsUnderstood) {
  const DeviceStatus said = valves();
  const auto devices = device_health(modbus_client::to_json("bench", {&said, 1}).dump());
  ASSERT_TRUE(devices);
  ASSERT_EQ(devices->size(), 1u);
  const dds::DeviceHealth& device = devices->front();
  EXPECT_EQ(device.name, "valves");
  EXPECT_EQ(device.endpoint, "10.0.0.2:502");
  EXPECT_EQ(device.unit, 7);
  EXPECT_TRUE(device.online);
  EXPECT_EQ(device.error, "timed out");
  EXPECT_EQ(device.requests, 12u);
  EXPECT_EQ(device.timeouts, 3u);
  EXPECT_NEAR(device.answer_max_us, 2'000.0, 1e-6);
  EXPECT_EQ(device.answer_age_ms, 30) << "the newest of its tags";
}

TEST(DeviceHealth, WhenNothingHasEverAnswered_ThenThereIsNoAge) {
  DeviceStatus said = valves();
  said.tags.clear();
  const auto devices = device_health(modbus_client::to_json("bench", {&said, 1}).dump());
  ASSERT_TRUE(devices);
  EXPECT_EQ(devices->front().answer_age_ms, -1);
}

TEST(DeviceHealth, WhenTheTextIsAnythingElse_ThenItIsRefused) {
  const DeviceStatus said = valves();
  const json good = modbus_client::to_json("bench", {&said, 1});
  EXPECT_FALSE(device_health(""));
  EXPECT_FALSE(device_health("[]"));
  EXPECT_FALSE(device_health("{}"));
  EXPECT_FALSE(device_health(R"({"devices": [7]})"));
  EXPECT_FALSE(device_health(good.dump().substr(0, 100)));
  for (const auto& [key, value] : good["devices"][0].items()) {
    if (key == "writes" || key == "groups") continue;  // not read
    json bad = good;
    bad["devices"][0].erase(key);
    EXPECT_FALSE(device_health(bad.dump())) << key << " is missing";
    bad["devices"][0][key] = json::object({{"x", json::object()}});
    EXPECT_EQ(device_health(bad.dump()).has_value(), key == "tags") << key << " is an object";
  }
}

}  // namespace
}  // namespace stepwright::link

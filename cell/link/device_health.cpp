#include "cell/link/device_health.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace stepwright::link {
namespace {

using nlohmann::json;

constexpr double kUsPerMs = 1'000.0;

// The newest value of any tag; a device without tags has none.
std::int64_t newest_age_ms(const json& tags) {
  std::int64_t newest = -1;
  for (const json& tag : tags) {
    const auto age = tag.find("age_ms");
    if (age == tag.end()) continue;
    const auto age_ms = age->get<std::int64_t>();
    if (age_ms >= 0 && (newest < 0 || age_ms < newest)) newest = age_ms;
  }
  return newest;
}

dds::DeviceHealth device_of(const json& said) {
  dds::DeviceHealth device;
  said.at("name").get_to(device.name);
  said.at("endpoint").get_to(device.endpoint);
  said.at("unit").get_to(device.unit);
  said.at("online").get_to(device.online);
  said.at("lost").get_to(device.lost);
  said.at("error").get_to(device.error);
  said.at("requests").get_to(device.requests);
  said.at("timeouts").get_to(device.timeouts);
  said.at("exceptions").get_to(device.exceptions);
  said.at("bad_answers").get_to(device.bad_answers);
  said.at("connection_losses").get_to(device.connection_losses);
  device.answer_p50_us = said.at("answer_p50_ms").get<double>() * kUsPerMs;
  device.answer_p99_us = said.at("answer_p99_ms").get<double>() * kUsPerMs;
  device.answer_max_us = said.at("answer_max_ms").get<double>() * kUsPerMs;
  device.answer_age_ms = newest_age_ms(said.at("tags"));
  return device;
}

}  // namespace

std::optional<std::vector<dds::DeviceHealth>> device_health(const std::string& text) {
  const json said = json::parse(text, nullptr, false);
  if (said.is_discarded()) return std::nullopt;
  try {
    std::vector<dds::DeviceHealth> devices;
    for (const json& each : said.at("devices")) devices.push_back(device_of(each));
    return devices;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace stepwright::link

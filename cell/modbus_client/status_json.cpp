#include "cell/modbus_client/status_json.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <utility>

namespace stepwright::modbus_client {
namespace {

using modbus::client::DeviceStatus;
using modbus::client::GroupStatus;
using modbus::client::TagStatus;
using nlohmann::json;

double ms(std::int64_t ns) {
  return static_cast<double>(ns) / 1e6;
}

std::string instant(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  const auto rest =
      std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count() % 1'000;
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(text.data() + length, text.size() - length, ".%03dZ", static_cast<int>(rest));
  return text.data();
}

json of_group(const GroupStatus& group) {
  return {{"name", group.name},
          {"period_ms", group.period_ms},
          {"turns", group.turns},
          {"overruns", group.overruns},
          {"period_p50_ms", ms(group.period.percentile_ns(50'000))},
          {"period_p99_ms", ms(group.period.percentile_ns(99'000))},
          {"period_max_ms", ms(group.period.max_ns())}};
}

json of_tag(const TagStatus& tag) {
  json said = {{"name", tag.name},
               {"address", tag.address},
               {"output", tag.output},
               {"quality", static_cast<int>(tag.quality)},
               {"quality_text", name_of(tag.quality)}};
  // JSON knows neither infinities nor NaN.
  said["value"] = std::isfinite(tag.value) ? json(tag.value) : json(nullptr);
  if (tag.age_ms >= 0) {
    said["age_ms"] = tag.age_ms;
    said["time"] = instant(tag.time);
  }
  return said;
}

json of_device(const DeviceStatus& device) {
  const modbus::client::DeviceCounters& counters = device.counters;
  json said = {{"name", device.name},
               {"endpoint", device.endpoint},
               {"unit", device.unit},
               {"online", device.online},
               {"lost", device.lost},
               {"error", device.error},
               {"requests", counters.requests},
               {"writes", counters.writes},
               {"timeouts", counters.timeouts},
               {"exceptions", counters.exceptions},
               {"bad_answers", counters.bad_answers},
               {"connection_losses", counters.connection_losses},
               {"answer_p50_ms", ms(counters.answer.percentile_ns(50'000))},
               {"answer_p99_ms", ms(counters.answer.percentile_ns(99'000))},
               {"answer_max_ms", ms(counters.answer.max_ns())}};
  said["groups"] = json::array();
  for (const GroupStatus& group : device.groups) said["groups"].push_back(of_group(group));
  said["tags"] = json::array();
  for (const TagStatus& tag : device.tags) said["tags"].push_back(of_tag(tag));
  return said;
}

template <typename... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace

json to_json(const std::string& cell, std::span<const DeviceStatus> devices) {
  json status = {{"cell", cell}, {"devices", json::array()}};
  for (const DeviceStatus& device : devices) status["devices"].push_back(of_device(device));
  return status;
}

std::string to_lines(const json& status) {
  std::string text;
  for (const json& device : status.at("devices")) {
    const auto str = [](const json& value) { return value.get<std::string>(); };
    const bool online = device.at("online").get<bool>();
    text += line("%-16s %s unit %d: %s%s", str(device.at("name")).c_str(), str(device.at("endpoint")).c_str(),
                 device.at("unit").get<int>(), online ? "online" : "offline",
                 device.at("lost").get<bool>() ? ", lost" : "");
    if (const std::string error = str(device.at("error")); !error.empty()) text += " (" + error + ")";
    text += line(
        "\n  %lld requests, %lld timeouts, %lld exceptions, %lld connections lost; answers p50 %.2f, p99 "
        "%.2f ms\n",
        device.at("requests").get<long long>(), device.at("timeouts").get<long long>(),
        device.at("exceptions").get<long long>(), device.at("connection_losses").get<long long>(),
        device.at("answer_p50_ms").get<double>(), device.at("answer_p99_ms").get<double>());
    for (const json& group : device.at("groups")) {
      text += line("  %s: every %lld ms, seen p50 %.1f, p99 %.1f, max %.1f ms, %lld left out\n",
                   str(group.at("name")).c_str(), group.at("period_ms").get<long long>(),
                   group.at("period_p50_ms").get<double>(), group.at("period_p99_ms").get<double>(),
                   group.at("period_max_ms").get<double>(), group.at("overruns").get<long long>());
    }
    for (const json& tag : device.at("tags")) {
      text += line("  %-10s %-20s ", str(tag.at("address")).c_str(), str(tag.at("name")).c_str());
      text +=
          tag.at("value").is_null() ? std::string("no number") : line("%.10g", tag.at("value").get<double>());
      text += ", " + str(tag.at("quality_text"));
      text +=
          tag.contains("age_ms") ? line(", %lld ms ago\n", tag.at("age_ms").get<long long>()) : ", never\n";
    }
  }
  return text;
}

}  // namespace stepwright::modbus_client

#include "cell/device_status/lost_devices.h"

#include <cstddef>
#include <nlohmann/json.hpp>

#include "cell/device_status/status_socket.h"

namespace stepwright::device_status {
namespace {

using nlohmann::json;

constexpr std::size_t kMostNamed = 8;

std::string sentence_of(const json& device) {
  std::string text = "device '" + device.at("name").get<std::string>() + "' (" +
                     device.at("endpoint").get<std::string>() + ")";
  const auto error = device.at("error").get<std::string>();
  return text + (error.empty() ? " does not answer" : ": " + error);
}

}  // namespace

std::string describe_lost(std::string_view status_json) {
  const json said = json::parse(status_json, nullptr, false);
  if (said.is_discarded()) return "the Modbus client says what is not understood";
  try {
    std::string text;
    std::size_t lost = 0;
    for (const json& device : said.at("devices")) {
      if (!device.at("lost").get<bool>() || ++lost > kMostNamed) continue;
      text += (text.empty() ? "" : "; ") + sentence_of(device);
    }
    if (lost > kMostNamed) text += "; and " + std::to_string(lost - kMostNamed) + " others";
    return lost > 0 ? text : "the Modbus client has all its devices: it was silent itself, or they are back";
  } catch (const json::exception&) {
    return "the Modbus client says what is not understood";
  }
}

std::string ask_lost(const std::filesystem::path& status_socket) {
  const auto text = ask_status(status_socket);
  return text ? describe_lost(*text) : result::to_string(text.error());
}

}  // namespace stepwright::device_status

#include "supervisor/fleet/vda5050/topic.h"

#include <algorithm>
#include <vector>

namespace stepwright::fleet::vda5050 {

namespace {

constexpr std::string_view kMajorVersion = "v2";

bool letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

bool of_serial_number(char c) {
  return letter_or_digit(c) || c == '_' || c == '.' || c == ':' || c == '-';
}

bool of_level(char c) {
  return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f && c != '/' && c != '+' && c != '#' && c != '$';
}

template <typename Allowed>
bool made_of(const std::string& text, Allowed allowed) {
  return !text.empty() && std::ranges::all_of(text, allowed);
}

}  // namespace

std::string_view to_string(Topic topic) {
  switch (topic) {
    case Topic::Order:
      return "order";
    case Topic::InstantActions:
      return "instantActions";
    case Topic::State:
      return "state";
    case Topic::Visualization:
      return "visualization";
    case Topic::Connection:
      return "connection";
    case Topic::Factsheet:
      return "factsheet";
  }
  return {};
}

result::Diagnostics check(const Address& address) {
  result::Diagnostics wrong;
  const auto refuse = [&](const char* part, const std::string& value, const char* hint) {
    wrong.push_back({.code = "F0906",
                     .severity = result::Severity::Error,
                     .where = {},
                     .message = std::string(part) + " '" + value + "' cannot be a level of a topic",
                     .hint = hint});
  };
  const char* const level = "write some characters, none of / + # $";
  if (!made_of(address.interface_name, of_level)) refuse("interfaceName", address.interface_name, level);
  if (!made_of(address.manufacturer, of_level)) refuse("manufacturer", address.manufacturer, level);
  if (!made_of(address.serial_number, of_serial_number)) {
    refuse("serialNumber", address.serial_number, "write letters, digits and _ . : - only");
  }
  return wrong;
}

std::string topic_name(const Address& address, Topic topic) {
  std::string name = address.interface_name;
  for (const std::string_view level : {kMajorVersion, std::string_view(address.manufacturer),
                                       std::string_view(address.serial_number), to_string(topic)}) {
    name.append("/").append(level);
  }
  return name;
}

std::optional<AddressedTopic> parse_topic_name(std::string_view name) {
  std::vector<std::string> levels(1);
  for (const char c : name) {
    if (c == '/') {
      levels.emplace_back();
    } else {
      levels.back().push_back(c);
    }
  }
  if (levels.size() != 5 || levels[1] != kMajorVersion) return std::nullopt;
  AddressedTopic found{{levels[0], levels[2], levels[3]}, Topic::Order};
  if (!check(found.address).empty()) return std::nullopt;
  const auto topic = std::ranges::find(kTopics, levels[4], [](Topic t) { return to_string(t); });
  if (topic == kTopics.end()) return std::nullopt;
  found.topic = *topic;
  return found;
}

Delivery delivery_of(Topic topic) {
  switch (topic) {
    case Topic::Connection:
      return {.qos = 1, .retained = true};
    case Topic::Factsheet:
      return {.qos = 0, .retained = true};
    default:
      return {};
  }
}

}  // namespace stepwright::fleet::vda5050

#pragma once

// The topics of VDA 5050 and where they are on a broker:
// interfaceName/majorVersion/manufacturer/serialNumber/ topic (version 2.1.0, sections 6.2, 6.3, 6.5).
//
// Values and pure functions; any thread.
//
//   topic_name({"uagv", "Stepwright", "v1"}, Topic::Order);   // uagv/v2/Stepwright/v1/order

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::fleet::vda5050 {

inline constexpr std::string_view kVersion = "2.1.0";

enum class Topic : std::uint8_t {
  Order,           // to the vehicle
  InstantActions,  // to the vehicle
  State,
  Visualization,
  Connection,
  Factsheet,
};
inline constexpr std::array kTopics = {Topic::Order,         Topic::InstantActions, Topic::State,
                                       Topic::Visualization, Topic::Connection,     Topic::Factsheet};

std::string_view to_string(Topic topic);

// Whose topics they are.
struct Address {
  std::string interface_name = "uagv";
  std::string manufacturer = "Stepwright";
  std::string serial_number;

  friend auto operator<=>(const Address&, const Address&) = default;
};

// F0906 for each part that is no level of a topic: empty, or with one of / + # $ or a control character; a
// serial number has letters, digits and _ . : - only. Messages name `serialNumber` and so on.
result::Diagnostics check(const Address& address);

// Requires an address that `check` accepts.
std::string topic_name(const Address& address, Topic topic);

struct AddressedTopic {
  Address address;
  Topic topic = Topic::Order;
};
// Nothing for a name that is not of this major version or of no topic of the standard.
std::optional<AddressedTopic> parse_topic_name(std::string_view name);

// How messages of a topic are sent.
struct Delivery {
  int qos = 0;
  bool retained = false;
};
Delivery delivery_of(Topic topic);

}  // namespace stepwright::fleet::vda5050

#pragma once

// Messages as JSON. Pure functions; any thread. What comes out keeps the rules of check_message if ids differ
// and nodes and edges are in order; text that is no UTF-8 is mended.
//
//   client.publish(topic_name(address, Topic::Order), to_json(order));

#include <string>

#include "supervisor/fleet/vda5050/factsheet.h"
#include "supervisor/fleet/vda5050/order.h"
#include "supervisor/fleet/vda5050/state.h"

namespace stepwright::fleet::vda5050 {

std::string to_json(const Order& order);
std::string to_json(const InstantActions& actions);
std::string to_json(const State& state);
std::string to_json(const Visualization& visualization);
std::string to_json(const Connection& connection);
std::string to_json(const Factsheet& factsheet);

}  // namespace stepwright::fleet::vda5050

#pragma once

// One sound message of each topic with most of its members, for tests that break them.
//
//   std::string text = sample_message(Topic::State);

#include <string>

#include "supervisor/fleet/vda5050/order.h"
#include "supervisor/fleet/vda5050/state.h"

namespace stepwright::fleet::vda5050 {

// Three nodes, the last one in the horizon.
Order sample_order();
State sample_state();
std::string sample_message(Topic topic);

}  // namespace stepwright::fleet::vda5050

#pragma once

// Check whether an order may be sent to a vehicle after another one: an update continues the base where it
// ends and changes nothing in it (VDA 5050 2.1.0, section 6.6.2).
//
// Pure functions; any thread. Requires orders that keep the rules of a single message (check_message.h).
//
//   const auto wrong = check_update(held, update, "update 3 of shift7.v1.1");

#include <string>

#include "runtime/ground/result/diagnostic.h"
#include "supervisor/fleet/vda5050/order.h"

namespace stepwright::fleet::vda5050 {

// F0905, with the JSON pointer into `update`: another orderId, an orderUpdateId that does not grow, a first
// node that is not the decision point of `held` in all its members (stitching node), or that is not released,
// ids of actions that the base has already.
result::Diagnostics check_update(const Order& held, const Order& update, const std::string& source);

// The order of a vehicle with `held` after `update`: the base of both and the new horizon. Requires an update
// that check_update accepts.
Order stitched(Order held, const Order& update);

}  // namespace stepwright::fleet::vda5050

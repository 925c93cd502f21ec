#pragma once

// The one way out to a broker: a message goes out only if it keeps all rules of VDA 5050.
//
//   if (!publish_checked(client, address, Topic::State, to_json(state), news.wrong)) ...

#include <string>

#include "runtime/ground/mqtt/client.h"
#include "runtime/ground/result/diagnostic.h"
#include "supervisor/fleet/vda5050/topic.h"

namespace stepwright::vda5050_link {

// False where it was not handed over: not connected, or against the rules, which `wrong` then says.
bool publish_checked(mqtt::Client& client, const fleet::vda5050::Address& address,
                     fleet::vda5050::Topic topic, const std::string& text, result::Diagnostics& wrong);

}  // namespace stepwright::vda5050_link

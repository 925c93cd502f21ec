#pragma once

// Messages that come in: whatever bytes, only what keeps all rules becomes a value (check_message.h, whose
// codes the diagnostics have). Pure functions; any thread.
//
//   auto state = read_state(payload, topic);
//   if (!state) for (const auto& wrong : state.error()) log(to_string(wrong));

#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/vda5050/order.h"
#include "supervisor/fleet/vda5050/state.h"

namespace stepwright::fleet::vda5050 {

[[nodiscard]] result::Result<State> read_state(std::string_view text, const std::string& source);
[[nodiscard]] result::Result<Connection> read_connection(std::string_view text, const std::string& source);
[[nodiscard]] result::Result<Order> read_order(std::string_view text, const std::string& source);
[[nodiscard]] result::Result<InstantActions> read_instant_actions(std::string_view text,
                                                                  const std::string& source);

}  // namespace stepwright::fleet::vda5050

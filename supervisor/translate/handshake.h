#pragma once

// A plan for a controller that takes no containers: somebody loads its program by hand, a supervisor commands
// it step by step through five registers and watches what it does (runtime/doc/modbus_by_hand.md).
//
// Before every action's step stands a gate, a step without outputs. The chart leaves it when the supervisor
// has granted the action, so that whatever is lost, the plant waits with all outputs of the plan off. What
// runs ends by itself: no completion waits for a command.
//
//   add_handshake(*translation);       // before lowering, drawing, writing
//
// Pure functions.

#include <array>
#include <cstdint>
#include <string>

#include "supervisor/translate/translation.h"

namespace stepwright::translate {

// One word each, of type INT, in this order from the first memory word on.
enum class HandshakeWord : std::uint8_t {
  Enable,   // by the supervisor: nothing but 0 lets gates open
  Go,       // by the supervisor: the number of the action that may start
  Waiting,  // the number of an action that waits at its gate; stands when it waits no more
  Started,  // the number of the action that started last
  Outcome,  // 0 under way, 1 done, 2 failed
};
inline constexpr std::array kHandshakeVariables = {"HS_ENABLE", "HS_GO", "HS_WAITING", "HS_STARTED",
                                                   "HS_OUTCOME"};
// "%MW0" of the first one: holding register 1024 of the standard map.
std::string handshake_address(HandshakeWord word);

// Adds gates and registers to the chart. Actions are numbered from 1 in the order of the plan. Fails with
// T0006 if the binding has a name of the handshake.
[[nodiscard]] result::Result<void> add_handshake(Translation& translation);

}  // namespace stepwright::translate

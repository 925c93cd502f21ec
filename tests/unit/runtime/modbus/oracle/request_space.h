#pragma once

// Every request of the model test: function codes 0 to 255 x boundary addresses x boundary counts x bodies
// that are whole, cut off, too long or of another byte count.

#include <vector>

#include "tests/unit/runtime/modbus/oracle/answer.h"
#include "tests/unit/runtime/modbus/oracle/tables.h"

namespace stepwright::modbus::oracle {

// Each once, at most 260 bytes, none empty. `only_known` leaves out the function codes that nobody here
// serves.
std::vector<Bytes> request_space(Sizes sizes, bool only_known);

}  // namespace stepwright::modbus::oracle

#pragma once

// pymodbus's server as a peer: ServerDecoder and execute of Debian's package, all requests in one run of
// pymodbus_peer.py.

#include <vector>

#include "tests/unit/runtime/modbus/oracle/answer.h"
#include "tests/unit/runtime/modbus/oracle/tables.h"

namespace stepwright::modbus::oracle {

// One answer for each request. Throws std::runtime_error with its output if the script fails.
std::vector<Answer> ask_pymodbus(Sizes sizes, const std::vector<Bytes>& requests);

}  // namespace stepwright::modbus::oracle

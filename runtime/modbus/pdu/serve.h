#pragma once

// The slave's engine in one synchronous call: parse, ask the model, build the answer. For slaves whose model
// answers at once (the firmware, tests); the host's server, whose writes wait for a scan, uses the parts.
//
// Portable, no heap. Called by the thread that owns the model.

#include <cstddef>
#include <span>

#include "runtime/modbus/pdu/data_model.h"
#include "runtime/modbus/pdu/request.h"

namespace stepwright::modbus::pdu {

// Carries the request out and writes the answer PDU into `out` (kMaxPdu bytes). Returns its length; 0 only
// for an empty request, which is answered with nothing.
std::size_t serve(DataModel& model, std::span<const std::byte> request, std::span<std::byte> out);

}  // namespace stepwright::modbus::pdu

#pragma once

// FC 43/14, read device identification (V1.1b3, 6.21): objects 0 to 6, stream and individual access,
// conformity level 0x82. Portable, no heap.

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/modbus/pdu/data_model.h"
#include "runtime/modbus/pdu/request.h"

namespace stepwright::modbus::pdu {

// Answers a request of FC 43/14 into `out` (kMaxPdu bytes); the length. Objects that do not fit are announced
// with "more follows". A stream of an unknown object begins with object 0; a single unknown object is
// exception 2. A client that asks for the extended objects, of which there are none, gets the regular ones.
std::size_t answer_identification(const Request& request, const Identity& device, std::span<std::byte> out);

}  // namespace stepwright::modbus::pdu

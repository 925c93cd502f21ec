#pragma once

// The addresses that a participant may use, held against those that this machine has: Fast DDS itself would
// say nothing about a wrong one and just hear nobody.

#include "runtime/dds/types.h"
#include "runtime/ground/result/result.h"

namespace stepwright::dds::internal {

// D0004: no IPv4 address, or none at all; D0006: none of this machine.
[[nodiscard]] result::Result<void> check_addresses(const ParticipantConfig& config);

}  // namespace stepwright::dds::internal

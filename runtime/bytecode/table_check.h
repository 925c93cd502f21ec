#pragma once

// The second stage of verification: every record of every table but the code itself.
// Afterwards every index, string, address and range in the tables can be followed without a check.

#include "runtime/bytecode/container_view.h"
#include "runtime/bytecode/verify_result.h"

namespace stepwright::bytecode {

// Requires a view from parse_container.
VerifyResult check_tables(const ContainerView& view);

}  // namespace stepwright::bytecode

#pragma once

// The built web client, embedded in the program: no file is needed beside the binary.
//
// Constant data; any thread. The page itself is the asset "/".

#include "hmi_web/protocol/asset.h"

namespace stepwright::client {

protocol::Assets client_assets();

}  // namespace stepwright::client

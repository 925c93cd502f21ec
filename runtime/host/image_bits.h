#pragma once

// What bits of an image mean as a force. Pure; any thread.

#include <optional>

#include "runtime/host/messages.h"
#include "runtime/image/force_table.h"

namespace stepwright::host {

// The force that bits stand for: one bit, or 1, 2, 4 or 8 whole bytes. None for any other mask.
std::optional<image::Force> to_force(const ImageBits& bits);

}  // namespace stepwright::host

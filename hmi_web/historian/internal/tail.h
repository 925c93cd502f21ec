#pragma once

// The samples of one write as one checksummed blob: tag, number of the open block, length, block, again and
// again (hmi_web/doc/history_format.md).
//
// Pure functions. Any bytes are safe to read.

#include <cstddef>
#include <span>
#include <vector>

#include "hmi_web/historian/history_file.h"

namespace stepwright::historian::internal {

std::vector<std::byte> encode_tail(const std::vector<OpenRow>& rows);
// False if the bytes are no sound tail; `rows` is unchanged then.
[[nodiscard]] bool decode_tail(std::span<const std::byte> bytes, std::vector<OpenRow>& rows);

}  // namespace stepwright::historian::internal

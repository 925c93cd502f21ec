#pragma once

// CRC-32C (Castagnoli), as iSCSI and ext4 use it: finds every burst of up to 32 wrong bits.
//
// Threads: any.

#include <cstddef>
#include <cstdint>
#include <span>

namespace stepwright::record {

// Of the bytes of both, one behind the other. crc32c of "123456789" is 0xE3069283.
std::uint32_t crc32c(std::span<const std::byte> bytes, std::span<const std::byte> more = {});

}  // namespace stepwright::record

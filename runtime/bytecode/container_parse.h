#pragma once

// The first stage of verification: the file as a file. Header, checksum, section table.

#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/bytecode/container_view.h"
#include "runtime/bytecode/verify_result.h"

namespace stepwright::bytecode {

// The checksum that belongs into FileHeader::checksum. Requires at least a header's bytes.
std::uint64_t container_checksum(std::span<const std::byte> bytes);

// Sets `view` if the header, the checksum and the section table are right. Says nothing about the records.
VerifyResult parse_container(std::span<const std::byte> bytes, ContainerView& view);

}  // namespace stepwright::bytecode

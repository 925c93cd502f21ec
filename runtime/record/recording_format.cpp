#include "runtime/record/recording_format.h"

#include <array>
#include <cstring>

#include "runtime/base/crc32c.h"

namespace stepwright::record {

std::uint32_t chunk_crc(const ChunkHeader& header, std::span<const std::byte> payload) {
  std::array<std::byte, sizeof header.sequence + sizeof header.bytes> head;
  std::memcpy(head.data(), &header.sequence, sizeof header.sequence);
  std::memcpy(head.data() + sizeof header.sequence, &header.bytes, sizeof header.bytes);
  return base::crc32c(payload, base::crc32c(head));
}

}  // namespace stepwright::record

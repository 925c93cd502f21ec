#include "runtime/record/recording_format.h"

#include <boost/crc.hpp>

namespace stepwright::record {

std::uint32_t chunk_crc(const ChunkHeader& header, std::span<const std::byte> payload) {
  // CRC-32C (Castagnoli), as iSCSI and ext4 use it.
  boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true> crc;
  crc.process_bytes(&header.sequence, sizeof header.sequence);
  crc.process_bytes(&header.bytes, sizeof header.bytes);
  crc.process_bytes(payload.data(), payload.size());
  return crc.checksum();
}

}  // namespace stepwright::record

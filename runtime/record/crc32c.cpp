#include "runtime/record/crc32c.h"

#include <boost/crc.hpp>

namespace stepwright::record {

std::uint32_t crc32c(std::span<const std::byte> bytes, std::span<const std::byte> more) {
  boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true> crc;
  crc.process_bytes(bytes.data(), bytes.size());
  crc.process_bytes(more.data(), more.size());
  return crc.checksum();
}

}  // namespace stepwright::record

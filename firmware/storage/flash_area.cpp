#include "firmware/storage/flash_area.h"

#include <cstring>

#include "runtime/base/crc32c.h"

namespace stepwright::storage {
namespace {

struct Header {
  std::uint32_t magic = 0x31465753;  // "SWF1"
  std::uint32_t sequence = 0;
  std::uint32_t bytes = 0;
  std::uint32_t data_crc = 0;
  Digest digest{};
  std::uint32_t header_crc = 0;  // of everything before it
};
static_assert(sizeof(Header) == 52);

std::span<const std::byte> bytes_of(const Header& header) {
  return std::as_bytes(std::span(&header, 1));
}
// Bit by bit: the table of the faster sum would be a kilobyte of flash.
std::uint32_t sum_of(const Header& header) {
  return base::crc32c_bitwise(bytes_of(header).first(offsetof(Header, header_crc)));
}

// False if there is no whole header.
bool header_at(const std::byte* at, Header& header) {
  std::memcpy(&header, at, sizeof(header));
  return header.magic == Header().magic && header.header_crc == sum_of(header);
}

}  // namespace

std::uint32_t FlashArea::sequence() const {
  Header header;
  return header_at(flash_.content().data() + offset_, header) ? header.sequence : 0;
}

bool FlashArea::read(FlashRecord& record) const {
  Header header;
  if (!header_at(flash_.content().data() + offset_, header) || header.bytes > capacity()) return false;
  const auto data = flash_.content().subspan(offset_ + kDataAt, header.bytes);
  if (base::crc32c_bitwise(data) != header.data_crc) return false;
  record = {header.sequence, header.digest, data};
  return true;
}

bool FlashArea::begin() {
  written_ = 0;
  crc_ = 0;
  return flash_.erase(offset_);
}

bool FlashArea::program(std::uint32_t at, std::span<const std::byte> bytes) {
  return flash_.program(offset_ + at, bytes) &&
         std::memcmp(flash_.content().data() + offset_ + at, bytes.data(), bytes.size()) == 0;
}

bool FlashArea::append(std::span<const std::byte> data) {
  const std::uint32_t page = flash_.page_bytes();
  if (data.size() > capacity() - written_) return false;
  while (!data.empty()) {
    const std::uint32_t at = kDataAt + written_;
    if (at % page == 0 && !flash_.erase(offset_ + at)) return false;
    const auto room = static_cast<std::size_t>(page - at % page);
    const auto part = data.first(data.size() < room ? data.size() : room);
    if (!program(at, part)) return false;
    crc_ = base::crc32c_bitwise(part, crc_);
    written_ += static_cast<std::uint32_t>(part.size());
    data = data.subspan(part.size());
  }
  return true;
}

bool FlashArea::finish(std::uint32_t sequence, const Digest& digest) {
  Header header;
  header.sequence = sequence;
  header.bytes = written_;
  header.data_crc = crc_;
  header.digest = digest;
  header.header_crc = sum_of(header);
  return program(0, bytes_of(header));
}

int newest_of(const FlashArea (&areas)[2], FlashRecord& record) {
  FlashRecord records[2];
  const bool whole[2] = {areas[0].read(records[0]), areas[1].read(records[1])};
  if (!whole[0] && !whole[1]) return -1;
  const bool second_is_newer = static_cast<std::int32_t>(records[1].sequence - records[0].sequence) > 0;
  const int newest = whole[0] && whole[1] ? (second_is_newer ? 1 : 0) : (whole[1] ? 1 : 0);
  record = records[newest];
  return newest;
}

}  // namespace stepwright::storage

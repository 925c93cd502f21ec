#include "hmi_web/historian/internal/tail.h"

#include <cstring>

#include "runtime/base/byte_reader.h"
#include "runtime/base/crc32c.h"

namespace stepwright::historian::internal {
namespace {

constexpr std::uint8_t kVersion = 1;

void append(std::vector<std::byte>& out, std::uint32_t value) {
  const auto at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(out.data() + at, &value, sizeof value);
}

}  // namespace

std::vector<std::byte> encode_tail(const std::vector<OpenRow>& rows) {
  std::vector<std::byte> bytes = {static_cast<std::byte>(kVersion)};
  for (const OpenRow& row : rows) {
    append(bytes, row.tag.value);
    append(bytes, row.number);
    append(bytes, static_cast<std::uint32_t>(row.block.size()));
    bytes.insert(bytes.end(), row.block.begin(), row.block.end());
  }
  append(bytes, base::crc32c(bytes));
  return bytes;
}

bool decode_tail(std::span<const std::byte> bytes, std::vector<OpenRow>& rows) {
  if (bytes.size() < 5) return false;
  const auto content = bytes.first(bytes.size() - 4);
  if (base::ByteReader(bytes.last(4)).read<std::uint32_t>() != base::crc32c(content)) return false;
  base::ByteReader in(content);
  if (in.read<std::uint8_t>() != kVersion) return false;
  std::vector<OpenRow> read;
  while (in.ok() && !in.at_end()) {
    OpenRow row;
    row.tag = TagId(in.read<std::uint32_t>());
    row.number = in.read<std::uint32_t>();
    const auto block = in.read_bytes(in.read<std::uint32_t>());
    row.block.assign(block.begin(), block.end());
    read.push_back(std::move(row));
  }
  if (!in.ok()) return false;
  rows.insert(rows.end(), std::make_move_iterator(read.begin()), std::make_move_iterator(read.end()));
  return true;
}

}  // namespace stepwright::historian::internal

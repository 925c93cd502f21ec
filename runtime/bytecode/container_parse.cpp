#include "runtime/bytecode/container_parse.h"

#include <array>
#include <cstddef>
#include <cstring>

#include "runtime/base/hash64.h"

namespace stepwright::bytecode {

namespace {

constexpr std::uint32_t kChecksummedHeader = 16;  // the header's bytes before the checksum

constexpr std::uint32_t kRecordSizes[kMostSections] = {
    sizeof(Record<Section::Sizes>),          sizeof(Record<Section::Strings>),
    sizeof(Record<Section::Types>),          sizeof(Record<Section::Members>),
    sizeof(Record<Section::Symbols>),        sizeof(Record<Section::Tasks>),
    sizeof(Record<Section::ProgramCalls>),   sizeof(Record<Section::Functions>),
    sizeof(Record<Section::Locals>),         sizeof(Record<Section::Code>),
    sizeof(Record<Section::Constants>),      sizeof(Record<Section::InitialData>),
    sizeof(Record<Section::IoMap>),          sizeof(Record<Section::RetainMap>),
    sizeof(Record<Section::SfcCharts>),      sizeof(Record<Section::SfcSteps>),
    sizeof(Record<Section::SfcTransitions>), sizeof(Record<Section::SfcLinks>),
    sizeof(Record<Section::SourceFiles>),    sizeof(Record<Section::SourceMap>),
    sizeof(Record<Section::Document>)};

VerifyResult file_error(VerifyStatus status, std::uint64_t offset) {
  return {.status = status, .offset = static_cast<std::uint32_t>(offset)};
}

VerifyResult check_header(std::span<const std::byte> bytes) {
  std::uint32_t magic = 0;
  if (bytes.size() < sizeof(magic)) return file_error(VerifyStatus::NotAContainer, 0);
  std::memcpy(&magic, bytes.data(), sizeof(magic));
  if (magic != kMagic) return file_error(VerifyStatus::NotAContainer, 0);
  if (bytes.size() < sizeof(FileHeader)) return file_error(VerifyStatus::Truncated, bytes.size());
  if (bytes.size() > kMaxContainerBytes) return file_error(VerifyStatus::TooLarge, 0);

  FileHeader header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.version != kVersion) return file_error(VerifyStatus::WrongVersion, 4);
  if (bytes.size() < header.total_bytes) return file_error(VerifyStatus::Truncated, bytes.size());
  if (bytes.size() > header.total_bytes) return file_error(VerifyStatus::TrailingBytes, header.total_bytes);
  if (header.checksum != container_checksum(bytes)) return file_error(VerifyStatus::BadChecksum, 16);
  const bool known = header.section_count == kSectionCount || header.section_count == kMostSections;
  if (!known || header.reserved != 0) return file_error(VerifyStatus::BadSectionTable, 6);
  return {};
}

constexpr std::uint64_t aligned(std::uint64_t offset) {
  return (offset + 7) / 8 * 8;
}

// Padding is zero, so that every byte of the file means one thing only.
bool all_zero(std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    if (byte != std::byte{0}) return false;
  }
  return true;
}

}  // namespace

std::uint64_t container_checksum(std::span<const std::byte> bytes) {
  return base::hash_bytes(bytes.subspan(sizeof(FileHeader)),
                          base::hash_bytes(bytes.first(kChecksummedHeader)));
}

VerifyResult parse_container(std::span<const std::byte> bytes, ContainerView& view) {
  if (const VerifyResult header = check_header(bytes); !header.ok()) return header;
  std::uint16_t count = 0;
  std::memcpy(&count, bytes.data() + offsetof(FileHeader, section_count), sizeof(count));
  std::array<SectionEntry, kMostSections> table;
  const std::size_t table_bytes = count * sizeof(SectionEntry);
  if (bytes.size() < sizeof(FileHeader) + table_bytes) {
    return file_error(VerifyStatus::BadSectionTable, sizeof(FileHeader));
  }
  std::memcpy(table.data(), bytes.data() + sizeof(FileHeader), table_bytes);

  std::uint64_t end = sizeof(FileHeader) + table_bytes;
  for (std::uint32_t i = 0; i < count; ++i) {
    const SectionEntry& entry = table[i];
    const VerifyResult bad = {VerifyStatus::BadSectionTable, static_cast<Section>(i), 0, entry.offset};
    const std::uint64_t start = aligned(end);
    if (entry.id != i || entry.reserved != 0 || entry.offset != start) return bad;
    if (start + entry.size > bytes.size() || entry.size % kRecordSizes[i] != 0) return bad;
    if (!all_zero(bytes.subspan(static_cast<std::size_t>(end), static_cast<std::size_t>(start - end))))
      return bad;
    end = start + entry.size;
  }
  if (end != bytes.size()) return file_error(VerifyStatus::BadSectionTable, end);
  // A file without a document has no section for it, so that a program means the same bytes.
  if (count == kMostSections &&
      (table[kSectionCount].size == 0 || table[kSectionCount].size > kMaxDocumentBytes))
    return {VerifyStatus::BadSectionTable, Section::Document, 0, table[kSectionCount].offset};
  view = ContainerView(bytes, std::span(table).first(count));
  return {};
}

}  // namespace stepwright::bytecode

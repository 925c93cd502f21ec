#include "runtime/bytecode/writer/section_buffers.h"

#include "runtime/bytecode/container_parse.h"

namespace stepwright::writer {

namespace {

std::size_t aligned(std::size_t offset) {
  return (offset + 7) / 8 * 8;
}

}  // namespace

bytecode::StringRef SectionBuffers::string(const std::string& text) {
  std::vector<std::byte>& bytes = buffer(bytecode::Section::Strings);
  const bytecode::StringRef fresh{static_cast<std::uint32_t>(bytes.size()),
                                  static_cast<std::uint32_t>(text.size())};
  const auto [entry, inserted] = strings_.try_emplace(text, fresh);
  if (inserted) {
    bytes.resize(bytes.size() + text.size());
    std::memcpy(bytes.data() + fresh.offset, text.data(), text.size());
  }
  return entry->second;
}

std::vector<std::byte> SectionBuffers::assemble() const {
  std::array<bytecode::SectionEntry, bytecode::kSectionCount> table{};
  std::size_t end = sizeof(bytecode::FileHeader) + sizeof(table);
  for (std::uint32_t i = 0; i < bytecode::kSectionCount; ++i) {
    const std::size_t start = aligned(end);
    table[i] = {i, static_cast<std::uint32_t>(start), static_cast<std::uint32_t>(sections_[i].size()), 0};
    end = start + sections_[i].size();
  }
  std::vector<std::byte> file(end);
  bytecode::FileHeader header{
      bytecode::kMagic, bytecode::kVersion, bytecode::kSectionCount, static_cast<std::uint32_t>(end), 0, 0};
  std::memcpy(file.data(), &header, sizeof(header));
  std::memcpy(file.data() + sizeof(header), table.data(), sizeof(table));
  for (std::uint32_t i = 0; i < bytecode::kSectionCount; ++i) {
    if (!sections_[i].empty())
      std::memcpy(file.data() + table[i].offset, sections_[i].data(), sections_[i].size());
  }
  header.checksum = bytecode::container_checksum(file);
  std::memcpy(file.data(), &header, sizeof(header));
  return file;
}

}  // namespace stepwright::writer

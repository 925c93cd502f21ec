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
  std::array<std::span<const std::byte>, bytecode::kSectionCount> sections;
  for (std::size_t i = 0; i < sections.size(); ++i) sections[i] = sections_[i];
  return writer::assemble(sections);
}

std::vector<std::byte> assemble(std::span<const std::span<const std::byte>> sections) {
  std::vector<bytecode::SectionEntry> table(sections.size());
  const std::size_t table_bytes = table.size() * sizeof(bytecode::SectionEntry);
  std::size_t end = sizeof(bytecode::FileHeader) + table_bytes;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::size_t start = aligned(end);
    table[i] = {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(start),
                static_cast<std::uint32_t>(sections[i].size()), 0};
    end = start + sections[i].size();
  }
  std::vector<std::byte> file(end);
  bytecode::FileHeader header{bytecode::kMagic,
                              bytecode::kVersion,
                              static_cast<std::uint16_t>(table.size()),
                              static_cast<std::uint32_t>(end),
                              0,
                              0};
  std::memcpy(file.data(), &header, sizeof(header));
  std::memcpy(file.data() + sizeof(header), table.data(), table_bytes);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (!sections[i].empty())
      std::memcpy(file.data() + table[i].offset, sections[i].data(), sections[i].size());
  }
  header.checksum = bytecode::container_checksum(file);
  std::memcpy(file.data(), &header, sizeof(header));
  return file;
}

}  // namespace stepwright::writer

#pragma once

// The sections of a container while they grow, and their assembly into the bytes of a file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "runtime/bytecode/container_view.h"

namespace stepwright::writer {

// Header, section table and sections with padding and checksum: kSectionCount or kMostSections of them.
std::vector<std::byte> assemble(std::span<const std::span<const std::byte>> sections);

class SectionBuffers {
 public:
  // Appends a record and returns its index.
  template <bytecode::Section S>
  std::uint32_t add(const bytecode::Record<S>& record) {
    std::vector<std::byte>& bytes = buffer(S);
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(record));
    std::memcpy(bytes.data() + at, &record, sizeof(record));
    return static_cast<std::uint32_t>(at / sizeof(record));
  }

  // A record that is there.
  template <bytecode::Section S>
  bytecode::Record<S> get(std::uint32_t index) const {
    bytecode::Record<S> record;
    std::memcpy(&record,
                sections_[static_cast<std::uint32_t>(S)].data() + std::size_t{index} * sizeof(record),
                sizeof(record));
    return record;
  }

  // Overwrites a record that is there.
  template <bytecode::Section S>
  void set(std::uint32_t index, const bytecode::Record<S>& record) {
    std::memcpy(buffer(S).data() + std::size_t{index} * sizeof(record), &record, sizeof(record));
  }

  template <bytecode::Section S>
  std::uint32_t count() const {
    return static_cast<std::uint32_t>(sections_[static_cast<std::uint32_t>(S)].size() /
                                      sizeof(bytecode::Record<S>));
  }

  std::vector<std::byte>& buffer(bytecode::Section section) {
    return sections_[static_cast<std::uint32_t>(section)];
  }

  // The text's place in the section Strings; equal texts share it.
  bytecode::StringRef string(const std::string& text);

  // All of them as a file, without a document.
  std::vector<std::byte> assemble() const;

 private:
  std::array<std::vector<std::byte>, bytecode::kSectionCount> sections_;
  std::map<std::string, bytecode::StringRef> strings_;
};

}  // namespace stepwright::writer

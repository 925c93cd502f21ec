#pragma once

// Reads the records of a container in place. Portable: no heap, no copy of the file.
// A view may come from bytes that nobody has verified yet; then only the checked functions of the verifier
// use it. Records and strings are bounds-checked by assertion only.
//
//   bytecode::FunctionRecord f = view.record<bytecode::Section::Functions>(3);

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "runtime/bytecode/container_format.h"
#include "runtime/bytecode/value_type.h"

namespace stepwright::bytecode {

static_assert(std::endian::native == std::endian::little, "records are read as they lie in the file");

template <Section S>
using Record = typename RecordOf<S>::Type;

class ContainerView {
 public:
  ContainerView() = default;

  // Requires a section table whose entries lie within `bytes`: kSectionCount or kMostSections of them.
  ContainerView(std::span<const std::byte> bytes, std::span<const SectionEntry> table) {
    assert(table.size() <= kMostSections);
    for (std::size_t i = 0; i < table.size(); ++i) {
      sections_[i] = bytes.subspan(table[i].offset, table[i].size);
    }
  }

  std::span<const std::byte> section(Section section) const {
    return sections_[static_cast<std::uint32_t>(section)];
  }

  template <Section S>
  std::uint32_t count() const {
    return static_cast<std::uint32_t>(section(S).size() / sizeof(Record<S>));
  }

  template <Section S>
  Record<S> record(std::uint32_t index) const {
    assert(index < count<S>());
    Record<S> out;
    std::memcpy(&out, section(S).data() + std::size_t{index} * sizeof(Record<S>), sizeof(Record<S>));
    return out;
  }

  SizesRecord sizes() const { return record<Section::Sizes>(0); }

  // UTF-8 text in the file, not terminated.
  std::span<const char> string(StringRef ref) const {
    const auto bytes = section(Section::Strings).subspan(ref.offset, ref.length);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  std::span<const std::byte> code(const FunctionRecord& function) const {
    return section(Section::Code).subspan(function.code_offset, function.code_size);
  }

  StackType local_type(const FunctionRecord& function, std::uint32_t local) const {
    return static_cast<StackType>(record<Section::Locals>(function.first_local + local));
  }

 private:
  std::array<std::span<const std::byte>, kMostSections> sections_{};
};

// Bytes of all four areas of the image; no overflow for a verified container.
constexpr std::uint64_t image_bytes(const SizesRecord& sizes) {
  return std::uint64_t{sizes.input_bytes} + sizes.output_bytes + sizes.marker_bytes + sizes.data_bytes;
}

// The image and the frames of `tasks` tasks behind it.
constexpr std::uint64_t memory_bytes(const SizesRecord& sizes, std::uint32_t tasks) {
  return image_bytes(sizes) + std::uint64_t{sizes.frame_bytes} * tasks;
}

}  // namespace stepwright::bytecode

#include "firmware/app/retained_values.h"

#include <cstring>

namespace stepwright::app {
namespace {

using bytecode::Section;

// Calls with the address of each range in the image, its place in the copy, and its bytes; the sum of those.
template <typename Use>
std::uint64_t for_each_range(const bytecode::Program& program, const Use& use) {
  const bytecode::ContainerView& view = program.container();
  std::uint64_t at = 0;
  for (std::uint32_t i = 0; i < view.count<Section::RetainMap>(); ++i) {
    const auto range = view.record<Section::RetainMap>(i);
    use(range.address, static_cast<std::size_t>(at), range.size);
    at += range.size;
  }
  return at;
}

}  // namespace

std::uint64_t retain_bytes(const bytecode::Program& program) {
  return for_each_range(program, [](std::uint32_t, std::size_t, std::uint32_t) {});
}

void copy_retained(const bytecode::Program& program, std::span<const std::byte> image,
                   std::span<std::byte> copy) {
  for_each_range(program, [&](std::uint32_t address, std::size_t at, std::uint32_t size) {
    std::memcpy(copy.data() + at, image.data() + address, size);
  });
}

void restore_retained(const bytecode::Program& program, std::span<const std::byte> copy,
                      std::span<std::byte> image) {
  for_each_range(program, [&](std::uint32_t address, std::size_t at, std::uint32_t size) {
    std::memcpy(image.data() + address, copy.data() + at, size);
  });
}

}  // namespace stepwright::app

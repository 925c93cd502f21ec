#include <cstring>

#include "firmware/app/machine.h"

namespace stepwright::app {

using bytecode::Section;

std::uint64_t retain_bytes(const bytecode::Program& program) {
  const bytecode::ContainerView& view = program.container();
  std::uint64_t bytes = 0;
  for (std::uint32_t i = 0; i < view.count<Section::RetainMap>(); ++i)
    bytes += view.record<Section::RetainMap>(i).size;
  return bytes;
}

void copy_retained(const bytecode::Program& program, std::span<const std::byte> image,
                   std::span<std::byte> copy) {
  std::size_t at = 0;
  const bytecode::ContainerView& view = program.container();
  for (std::uint32_t i = 0; i < view.count<Section::RetainMap>(); ++i) {
    const auto range = view.record<Section::RetainMap>(i);
    std::memcpy(copy.data() + at, image.data() + range.address, range.size);
    at += range.size;
  }
}

void restore_retained(const bytecode::Program& program, std::span<const std::byte> copy,
                      std::span<std::byte> image) {
  std::size_t at = 0;
  const bytecode::ContainerView& view = program.container();
  for (std::uint32_t i = 0; i < view.count<Section::RetainMap>(); ++i) {
    const auto range = view.record<Section::RetainMap>(i);
    std::memcpy(image.data() + range.address, copy.data() + at, range.size);
    at += range.size;
  }
}

}  // namespace stepwright::app

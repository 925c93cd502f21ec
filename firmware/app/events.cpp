#include "firmware/app/events.h"

#include <cstring>

namespace stepwright::app {

using bytecode::Section;

void Events::use(std::span<std::byte> copy, std::span<const std::byte> image) {
  copy_ = copy;
  if (!copy_.empty()) std::memcpy(copy_.data(), image.data(), copy_.size());
}

void Events::record(modbus::control::Event kind, std::uint64_t scan, std::span<const std::byte> image) {
  ++number_;
  kind_ = kind;
  scan_ = scan;
  use(copy_, image);
}

bool Events::steps_changed(const bytecode::Program& program, std::span<const std::byte> image) const {
  const bytecode::ContainerView& view = program.container();
  for (std::uint32_t i = 0; i < view.count<Section::SfcSteps>(); ++i) {
    const auto step = view.record<Section::SfcSteps>(i);
    const std::byte mask = step.bit == bytecode::kNoBit ? std::byte{0xFF} : std::byte{1} << step.bit;
    if (((image[step.address] ^ copy_[step.address]) & mask) != std::byte{0}) return true;
  }
  return false;
}

}  // namespace stepwright::app

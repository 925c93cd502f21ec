#include "runtime/host/step_watch.h"

namespace stepwright::host {

using bytecode::Section;

StepWatch::StepWatch(const bytecode::Program& program) {
  const bytecode::ContainerView& view = program.container();
  for (std::uint32_t i = 0; i < view.count<Section::SfcSteps>(); ++i) {
    const auto step = view.record<Section::SfcSteps>(i);
    const auto mask = step.bit == bytecode::kNoBit ? std::byte{0xFF} : std::byte{1} << step.bit;
    bits_.push_back({step.address, mask});
  }
  before_.resize(bits_.size());
}

void StepWatch::reset(std::span<const std::byte> image) {
  static_cast<void>(changed(image));
}

bool StepWatch::changed(std::span<const std::byte> image) {
  auto difference = std::byte{0};
  for (std::size_t i = 0; i < bits_.size(); ++i) {
    const std::byte now = image[bits_[i].address] & bits_[i].mask;
    difference |= now ^ before_[i];
    before_[i] = now;
  }
  return difference != std::byte{0};
}

}  // namespace stepwright::host

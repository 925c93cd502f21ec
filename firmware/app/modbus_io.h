#pragma once

// The plant on the other side of Modbus: inputs come with the inputs block, outputs are read from the image.
// Called by the main loop only.

#include <array>
#include <cstring>
#include <span>

#include "firmware/app/limits.h"
#include "runtime/image/io_driver.h"

namespace stepwright::app {

class ModbusIo final : public image::IoDriver {
 public:
  // New inputs; they take effect with the next scan. Requires no more than kMaxInputBytes.
  void write(std::span<const std::byte> inputs) {
    if (!inputs.empty()) std::memcpy(inputs_.data(), inputs.data(), inputs.size());
  }
  // All inputs off, as those of a plant that has said nothing yet.
  void clear() { inputs_.fill(std::byte{0}); }
  // The plant is silent; outputs have to be safe.
  void set_lost(bool lost) { lost_ = lost; }

  image::IoStatus read_inputs(std::int64_t, std::span<std::byte> inputs) override {
    if (lost_) return image::IoStatus::Lost;
    if (!inputs.empty()) std::memcpy(inputs.data(), inputs_.data(), inputs.size());
    return image::IoStatus::Good;
  }
  image::IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override {
    return lost_ ? image::IoStatus::Lost : image::IoStatus::Good;
  }

 private:
  std::array<std::byte, kMaxInputBytes> inputs_{};
  bool lost_ = false;
};

}  // namespace stepwright::app

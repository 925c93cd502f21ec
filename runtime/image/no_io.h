#pragma once

// A driver of nothing: inputs stay as they are, outputs go nowhere. For programs that run without a plant.
//
// Threads: any.

#include "runtime/image/io_driver.h"

namespace stepwright::image {

class NoIo final : public IoDriver {
 public:
  IoStatus read_inputs(std::int64_t, std::span<std::byte>) override { return IoStatus::Good; }
  IoStatus write_outputs(std::int64_t, std::span<const std::byte>) override { return IoStatus::Good; }
};

}  // namespace stepwright::image

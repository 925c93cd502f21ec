#include "cell/modbus_client/field_outputs.h"

namespace stepwright::modbus_client {

using io_memory::Owner;

FieldOutputs::FieldOutputs(const scan::SafeMatrix& matrix, std::size_t bytes,
                           std::chrono::nanoseconds holder_timeout)
    : outputs_(bytes), memory_(bytes), safe_(matrix, memory_), holder_timeout_ns_(holder_timeout.count()) {}

std::optional<std::span<const std::byte>> FieldOutputs::turn(io_memory::PlantSide& plant) {
  const Owner owner = plant.owner();
  const bool held = owner == Owner::Runtime || owner == Owner::Guard;
  const bool silent = held && plant.holder_silence_ns() > holder_timeout_ns_;
  if (!silent) {
    deserted_ = false;
    driven_ = plant.read_outputs(outputs_).has_value() || driven_;
    return driven_ ? std::optional(std::span<const std::byte>(outputs_)) : std::nullopt;
  }
  const std::int64_t now_ns = io_memory::monotonic_ns();
  if (!deserted_) {
    // What he wrote last may be newer than what was read last.
    driven_ = plant.read_outputs(outputs_).has_value() || driven_;
    deserted_ = true;
    enter(scan::SafeCause::Killed, now_ns);
  }
  if (!driven_) return std::nullopt;
  safe_.apply(now_ns, outputs_);
  return std::span<const std::byte>(outputs_);
}

void FieldOutputs::enter(scan::SafeCause cause, std::int64_t now_ns) {
  safe_.driven(outputs_);
  safe_.enter(cause, now_ns);
}

std::optional<std::span<const std::byte>> FieldOutputs::last() {
  if (!driven_) return std::nullopt;
  const std::int64_t now_ns = io_memory::monotonic_ns();
  if (!deserted_) enter(scan::SafeCause::IoLost, now_ns);
  // Ramps have no time left: they are at their end.
  constexpr std::int64_t kLongNs = 3'600'000'000'000;
  safe_.apply(now_ns + kLongNs, outputs_);
  return std::span<const std::byte>(outputs_);
}

}  // namespace stepwright::modbus_client

#pragma once

// Outputs for the devices: what the runtime, or its guard, says in the shared-memory area, for as long as one
// of them is alive; else the column `killed` of [safe_state], ramps included. That is the second net: with a
// guard it is of use only when runtime and guard are gone together.
//
// Threads: one. No heap after the constructor.
//
//   FieldOutputs field(matrix, 64, 1s);
//   if (const auto outputs = field.turn(plant)) client.set_outputs(*outputs);

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/io_memory/plant_side.h"
#include "runtime/scan/safe_state.h"

namespace stepwright::modbus_client {

class FieldOutputs {
 public:
  // The data of the matrix must outlive this object.
  FieldOutputs(const scan::SafeMatrix& matrix, std::size_t bytes, std::chrono::nanoseconds holder_timeout);

  // Nothing as long as nobody has ever driven: the devices keep what they have.
  std::optional<std::span<const std::byte>> turn(io_memory::PlantSide& plant);
  // The safe outputs of lost I/O, for the end of this process: the runtime will see it as lost, too. Nothing
  // if nobody ever drove.
  std::optional<std::span<const std::byte>> last();

  // Nobody is left who drives, and the safe outputs are ours.
  bool deserted() const { return deserted_; }

 private:
  void enter(scan::SafeCause cause, std::int64_t now_ns);

  std::vector<std::byte> outputs_;
  std::vector<std::byte> memory_;
  scan::SafeState safe_;
  std::int64_t holder_timeout_ns_;
  bool driven_ = false;
  bool deserted_ = false;
};

}  // namespace stepwright::modbus_client

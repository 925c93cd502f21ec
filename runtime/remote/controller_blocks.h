#pragma once

// The status and outputs blocks of a controller as values, read from their registers
// (runtime/doc/modbus_controller.md). Pure; any thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/bytecode/trap.h"
#include "runtime/image/image_bits.h"
#include "runtime/modbus/control/registers.h"

namespace stepwright::remote {

namespace control = modbus::control;

// SHA-256; all zero where there is no program.
using ProgramDigest = std::array<std::byte, 32>;

struct ControllerStatus {
  std::uint16_t magic = 0;
  std::uint16_t version = 0;
  control::State state = control::State::Empty;
  std::uint16_t flags = 0;  // control::Flag
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;
  std::uint64_t trace_hash = 0;
  ProgramDigest digest{};
  bytecode::Trap trap;
  std::uint16_t command_number = 0;
  control::Refusal command_result = control::Refusal::Done;
  std::uint32_t command_detail = 0;
  std::uint32_t event = 0;
  control::Event event_kind = control::Event::Started;
  std::uint64_t event_scan = 0;
  std::uint32_t image_bytes = 0;
  std::uint16_t input_bytes = 0;
  std::uint16_t output_bytes = 0;
  std::uint32_t program_bytes = 0;
  std::uint32_t max_program_bytes = 0;
  std::uint32_t max_image_bytes = 0;
  std::uint32_t scan_max_us = 0;
  std::uint32_t overruns = 0;
  std::uint16_t resets = 0;
  std::uint32_t uptime_ms = 0;

  bool lock_step() const { return (flags & control::kLockStep) != 0; }
  bool inputs_lost() const { return (flags & control::kInputsLost) != 0; }
};

// Requires status::kCount words.
ControllerStatus status_from(std::span<const std::uint16_t> words);

struct ControllerOutputs {
  std::uint16_t turn = 0;
  control::State state = control::State::Empty;
  std::uint64_t scan = 0;
  std::int64_t time_ns = 0;
  std::uint64_t trace_hash = 0;
  std::uint32_t event = 0;
  std::int64_t next_ns = 0;
};

// Requires outputs::kData words at least; the bytes of the outputs stand behind them.
ControllerOutputs outputs_from(std::span<const std::uint16_t> words);

// The arguments of the commands that write, force and release bits of a program. `ms`: when a force ends, 0:
// never.
std::array<std::uint16_t, control::bits::kCount> bits_arguments(const image::ImageBits& bits,
                                                                const ProgramDigest& program,
                                                                std::uint64_t ms = 0);

}  // namespace stepwright::remote

#include "runtime/remote/controller_blocks.h"

namespace stepwright::remote {

using control::get32;
using control::get64;

ControllerStatus status_from(std::span<const std::uint16_t> words) {
  using namespace control::status;
  ControllerStatus status;
  status.magic = words[kMagicAt];
  status.version = words[kVersionAt];
  status.state = static_cast<control::State>(words[kState]);
  status.flags = words[kFlags];
  status.scan = get64(words, kScan);
  status.time_ns = static_cast<std::int64_t>(get64(words, kTimeNs));
  status.trace_hash = get64(words, kTraceHash);
  control::get_bytes(words.subspan(kDigest), status.digest);
  // A code that this side does not know is a fault of the program all the same.
  status.trap.code = words[kTrapCode] < bytecode::kTrapCodeCount
                         ? static_cast<bytecode::TrapCode>(words[kTrapCode])
                         : bytecode::TrapCode::UserTrap;
  status.trap.function = get32(words, kTrapFunction);
  status.trap.pc = get32(words, kTrapPc);
  status.trap.caller = get32(words, kTrapCaller);
  status.trap.return_pc = get32(words, kTrapReturnPc);
  status.command_number = words[kCommandNumber];
  status.command_result = static_cast<control::Refusal>(words[kCommandResult]);
  status.command_detail = get32(words, kCommandDetail);
  status.event = get32(words, kEvent);
  status.event_kind = static_cast<control::Event>(words[kEventKind]);
  status.event_scan = get64(words, kEventScan);
  status.image_bytes = get32(words, kImageBytes);
  status.input_bytes = words[kInputBytes];
  status.output_bytes = words[kOutputBytes];
  status.program_bytes = get32(words, kProgramBytes);
  status.max_program_bytes = get32(words, kMaxProgramBytes);
  status.max_image_bytes = get32(words, kMaxImageBytes);
  status.scan_max_us = get32(words, kScanMaxUs);
  status.overruns = get32(words, kOverruns);
  status.resets = words[kResets];
  status.uptime_ms = get32(words, kUptimeMs);
  return status;
}

ControllerOutputs outputs_from(std::span<const std::uint16_t> words) {
  using namespace control::outputs;
  ControllerOutputs outputs;
  outputs.turn = words[kTurn];
  outputs.state = static_cast<control::State>(words[kState]);
  outputs.scan = get64(words, kScan);
  outputs.time_ns = static_cast<std::int64_t>(get64(words, kTimeNs));
  outputs.trace_hash = get64(words, kTraceHash);
  outputs.event = get32(words, kEvent);
  outputs.next_ns = static_cast<std::int64_t>(get64(words, kNextNs));
  return outputs;
}

std::array<std::uint16_t, control::bits::kCount> bits_arguments(const image::ImageBits& bits,
                                                                const ProgramDigest& program,
                                                                std::uint64_t ms) {
  using namespace control::bits;
  std::array<std::uint16_t, kCount> arguments{};
  control::put32(arguments, kByte, bits.byte_offset);
  control::put64(arguments, kMask, bits.mask);
  control::put64(arguments, kValue, bits.value & bits.mask);
  control::put_bytes(std::span(arguments).subspan(kDigest), std::span(program).first(kDigestBytes));
  control::put64(arguments, kMs, ms);
  return arguments;
}

}  // namespace stepwright::remote

#include "firmware/app/status_block.h"

namespace stepwright::app {

namespace control = modbus::control;
namespace status = modbus::control::status;

namespace {

std::uint32_t microseconds(std::int64_t ns) {
  return static_cast<std::uint32_t>(ns / 1000);
}

std::uint64_t bits_of(std::int64_t value) {
  return static_cast<std::uint64_t>(value);
}

void put_trap(const bytecode::Trap& trap, std::span<std::uint16_t> words) {
  words[status::kTrapCode] = static_cast<std::uint16_t>(trap.code);
  control::put32(words, status::kTrapFunction, trap.function);
  control::put32(words, status::kTrapPc, trap.pc);
  control::put32(words, status::kTrapCaller, trap.caller);
  control::put32(words, status::kTrapReturnPc, trap.return_pc);
}

void put_program(Controller& controller, std::span<std::uint16_t> words) {
  const Machine& machine = controller.machine();
  const std::span<const std::byte> container = machine.container();
  control::put_bytes(words.subspan(status::kDigest), machine.digest());
  control::put32(words, status::kProgramBytes, static_cast<std::uint32_t>(container.size()));
  words[status::kSlot] = static_cast<std::uint16_t>(controller.slot() < 0 ? 0 : controller.slot());
  control::put32(words, status::kImageBytes, static_cast<std::uint32_t>(controller.machine().image().size()));
  words[status::kInputBytes] = static_cast<std::uint16_t>(controller.machine().inputs().size());
  words[status::kOutputBytes] = static_cast<std::uint16_t>(controller.machine().outputs().size());
}

void put_figures(const ScanFigures& figures, std::span<std::uint16_t> words) {
  control::put64(words, status::kScan, figures.scan);
  control::put64(words, status::kTimeNs, bits_of(figures.time_ns));
  control::put64(words, status::kTraceHash, figures.trace_hash);
  control::put64(words, status::kImageHash, figures.image_hash);
  control::put32(words, status::kScanUs, microseconds(figures.took_ns));
  control::put32(words, status::kScanMaxUs, microseconds(figures.longest_ns));
  control::put32(words, status::kOverruns, static_cast<std::uint32_t>(figures.overruns));
}

}  // namespace

void fill_status(Controller& controller, std::span<std::uint16_t, status::kCount> words) {
  Machine& machine = controller.machine();
  words[status::kMagicAt] = control::kMagic;
  words[status::kVersionAt] = control::kVersion;
  words[status::kState] = static_cast<std::uint16_t>(machine.state());
  words[status::kFlags] = controller.flags();
  put_figures(machine.figures(), words);
  put_trap(machine.trap(), words);
  put_program(controller, words);
  const CommandAnswer& answer = controller.answer();
  words[status::kCommandNumber] = answer.number;
  words[status::kCommandResult] = static_cast<std::uint16_t>(answer.result.refusal);
  control::put32(words, status::kCommandDetail, answer.result.detail);
  const Events& events = machine.events();
  control::put32(words, status::kEvent, events.number());
  words[status::kEventKind] = static_cast<std::uint16_t>(events.kind());
  control::put64(words, status::kEventScan, events.scan());
  control::put32(words, status::kTransferBytes, controller.transfer().arrived());
  control::put32(words, status::kMaxProgramBytes, controller.max_program_bytes());
  control::put32(words, status::kMaxImageBytes, controller.max_image_bytes());
  words[status::kResets] = controller.resets();
  control::put32(words, status::kUptimeMs, controller.uptime_ms());
}

void fill_outputs(Controller& controller, std::span<std::uint16_t, control::kMaxRead> words) {
  namespace outputs = control::outputs;
  Machine& machine = controller.machine();
  const ScanFigures figures = machine.figures();
  words[outputs::kTurn] = controller.turn();
  words[outputs::kState] = static_cast<std::uint16_t>(machine.state());
  control::put64(words, outputs::kScan, figures.scan);
  control::put64(words, outputs::kTimeNs, bits_of(figures.time_ns));
  control::put64(words, outputs::kTraceHash, figures.trace_hash);
  control::put32(words, outputs::kEvent, machine.events().number());
  control::put64(words, outputs::kNextNs, bits_of(machine.next_time_ns()));
  control::put_bytes(words.subspan(outputs::kData), machine.outputs());
}

void fill_window(Controller& controller, const Selection& selection,
                 std::span<std::uint16_t, control::window::kCount> words) {
  namespace window = control::window;
  Machine& machine = controller.machine();
  const bool event = selection.what == control::Memory::EventImage;
  control::put64(words, window::kScan, event ? machine.events().scan() : machine.figures().scan);
  control::put32(words, window::kEvent, machine.events().number());
  std::span<const std::byte> memory = machine.image();
  if (event) memory = machine.events().image();
  if (selection.what == control::Memory::Program) memory = machine.container();
  if (selection.offset >= memory.size()) return;
  memory = memory.subspan(selection.offset);
  if (memory.size() > window::kMaxBytes) memory = memory.first(window::kMaxBytes);
  control::put_bytes(words.subspan(window::kData), memory);
}

}  // namespace stepwright::app

#include "tests/support/modbus_controller/control_registers.h"

#include <algorithm>
#include <string_view>

namespace stepwright::support {
namespace {

using modbus::pdu::Exception;

constexpr std::size_t kBitsArguments = 10;
constexpr std::uint32_t kPlaceholderScanUs = 20;  // a duration that readers can recognise

std::uint16_t word_at(std::span<const std::byte> bytes, std::size_t index) {
  return static_cast<std::uint16_t>(std::to_integer<unsigned>(bytes[2 * index]) << 8 |
                                    std::to_integer<unsigned>(bytes[2 * index + 1]));
}

bool within(std::uint16_t address, std::uint16_t count, std::uint16_t first, std::size_t size) {
  return address >= first && std::size_t{address} + count <= first + size;
}

void put(std::span<const std::uint16_t> words, std::span<std::byte> bytes) {
  for (std::size_t i = 0; i < bytes.size() / 2; ++i) {
    bytes[2 * i] = static_cast<std::byte>(words[i] >> 8);
    bytes[2 * i + 1] = static_cast<std::byte>(words[i] & 0xFF);
  }
}

}  // namespace

void ControlRegisters::fill_status(std::span<std::uint16_t> words) const {
  using namespace control::status;
  words[kMagicAt] = control::kMagic;
  words[kVersionAt] = control::kVersion;
  words[kState] = static_cast<std::uint16_t>(model_.state());
  words[kFlags] = model_.flags();
  control::put64(words, kScan, model_.scan());
  control::put64(words, kTimeNs, static_cast<std::uint64_t>(model_.time_ns()));
  control::put64(words, kTraceHash, model_.trace_hash());
  control::put64(words, kImageHash, model_.image_hash());
  control::put_bytes(words.subspan(kDigest), model_.digest());
  words[kTrapCode] = static_cast<std::uint16_t>(model_.trap().code);
  control::put32(words, kTrapFunction, model_.trap().function);
  control::put32(words, kTrapPc, model_.trap().pc);
  control::put32(words, kTrapCaller, model_.trap().caller);
  control::put32(words, kTrapReturnPc, model_.trap().return_pc);
  words[kCommandNumber] = number_;
  words[kCommandResult] = static_cast<std::uint16_t>(answer_.refusal);
  control::put32(words, kCommandDetail, answer_.detail);
  control::put32(words, kEvent, model_.event());
  words[kEventKind] = static_cast<std::uint16_t>(model_.event_kind());
  control::put64(words, kEventScan, model_.event_scan());
  control::put32(words, kImageBytes, static_cast<std::uint32_t>(model_.image().size()));
  words[kInputBytes] = model_.input_bytes();
  words[kOutputBytes] = static_cast<std::uint16_t>(model_.outputs().size());
  control::put32(words, kProgramBytes, static_cast<std::uint32_t>(model_.program().size()));
  control::put32(words, kTransferBytes, model_.transferred());
  control::put32(words, kMaxProgramBytes, model_.limits().max_program_bytes);
  control::put32(words, kMaxImageBytes, model_.limits().max_image_bytes);
  control::put32(words, kScanUs, kPlaceholderScanUs);
  control::put32(words, kScanMaxUs, kPlaceholderScanUs);
  control::put32(words, kUptimeMs, model_.uptime_ms());
}

void ControlRegisters::fill_window(std::span<std::uint16_t> words) const {
  using namespace control::window;
  const bool of_event = what_ == control::Memory::EventImage;
  control::put64(words, kScan, of_event ? model_.event_scan() : model_.scan());
  control::put32(words, kEvent, model_.event());
  const std::span<const std::byte> memory = what_ == control::Memory::Program ? model_.program()
                                            : of_event                        ? model_.event_image()
                                                                              : model_.image();
  if (offset_ >= memory.size()) return;
  control::put_bytes(words.subspan(kData),
                     memory.subspan(offset_, std::min<std::size_t>(kMaxBytes, memory.size() - offset_)));
}

void ControlRegisters::fill_outputs(std::span<std::uint16_t> words) const {
  using namespace control::outputs;
  words[kTurn] = model_.newest_turn();
  words[kState] = static_cast<std::uint16_t>(model_.state());
  control::put64(words, kScan, model_.scan());
  control::put64(words, kTimeNs, static_cast<std::uint64_t>(model_.time_ns()));
  control::put64(words, kTraceHash, model_.trace_hash());
  control::put32(words, kEvent, model_.event());
  control::put64(words, kNextNs, static_cast<std::uint64_t>(model_.next_ns()));
  control::put_bytes(words.subspan(kData), model_.outputs());
}

Exception ControlRegisters::read_registers(modbus::pdu::RegisterTable table, std::uint16_t address,
                                           std::uint16_t count, std::span<std::byte> bytes) {
  if (table != modbus::pdu::RegisterTable::Holding) return Exception::IllegalDataAddress;
  std::array<std::uint16_t, control::kMaxRead> words{};
  std::uint16_t first = 0;
  if (within(address, count, control::status::kFirst, control::status::kCount)) {
    first = control::status::kFirst;
    fill_status(words);
  } else if (within(address, count, control::window::kFirst, control::window::kCount)) {
    first = control::window::kFirst;
    fill_window(words);
  } else if (within(address, count, control::outputs::kFirst, control::kMaxRead)) {
    first = control::outputs::kFirst;
    fill_outputs(words);
  } else {
    return Exception::IllegalDataAddress;
  }
  put(std::span(words).subspan(address - first, count), bytes);
  return Exception::None;
}

Exception ControlRegisters::write_registers(std::uint16_t address, std::uint16_t count,
                                            std::span<const std::byte> bytes) {
  std::array<std::uint16_t, control::kMaxWrite> all{};
  for (std::size_t i = 0; i < count; ++i) all[i] = word_at(bytes, i);
  const auto words = std::span<const std::uint16_t>(all).first(count);
  if (address == control::command::kFirst) {
    if (count < 2 || count > control::command::kMaxCount) return Exception::IllegalDataValue;
    command(words);
  } else if (address == control::transfer::kFirst) {
    if (count <= control::transfer::kData) return Exception::IllegalDataValue;
    std::array<std::byte, control::transfer::kMaxBytes> data{};
    const std::uint16_t size = words[control::transfer::kBytes];
    if (size == 0 || (size + 1) / 2 != count - control::transfer::kData) return Exception::IllegalDataValue;
    const auto piece = std::span(data).first(size);
    control::get_bytes(words.subspan(control::transfer::kData), piece);
    if (!model_.piece(control::get32(words, control::transfer::kOffset), piece))
      return Exception::IllegalDataValue;
  } else if (address == control::select::kFirst) {
    if (count != control::select::kCount || words[control::select::kWhat] > 2)
      return Exception::IllegalDataValue;
    what_ = static_cast<control::Memory>(words[control::select::kWhat]);
    offset_ = control::get32(words, control::select::kOffset);
  } else if (address == control::inputs::kFirst) {
    const std::size_t most = control::inputs::kData + (std::size_t{model_.input_bytes()} + 1) / 2;
    if (words[control::inputs::kTurn] == 0 || count > most) return Exception::IllegalDataValue;
    std::array<std::byte, control::inputs::kMaxBytes> data{};
    const auto inputs = std::span(data).first(2 * std::size_t{count} - 2);
    control::get_bytes(words.subspan(control::inputs::kData), inputs);
    model_.turn(words[control::inputs::kTurn], inputs);
  } else {
    const bool inside = address > control::command::kFirst && address < control::kEnd;
    return inside ? Exception::IllegalDataValue : Exception::IllegalDataAddress;
  }
  return Exception::None;
}

Exception ControlRegisters::read_write_registers(const modbus::pdu::ReadWrite& what,
                                                 std::span<std::byte> words) {
  // Whole or not at all: what cannot be read is found before anything is written.
  if (const auto readable =
          read_registers(modbus::pdu::RegisterTable::Holding, what.read_address, what.read_count, words);
      readable != Exception::None)
    return readable;
  if (const auto written = write_registers(what.write_address, what.write_count, what.words);
      written != Exception::None)
    return written;
  return read_registers(modbus::pdu::RegisterTable::Holding, what.read_address, what.read_count, words);
}

void ControlRegisters::command(std::span<const std::uint16_t> words) {
  const std::uint16_t number = words[control::command::kNumber];
  if (number == number_) return;
  answer_ = carry_out(static_cast<control::Command>(words[control::command::kCode]),
                      words.subspan(control::command::kArguments));
  number_ = number;
}

ModelAnswer ControlRegisters::carry_out(control::Command code, std::span<const std::uint16_t> arguments) {
  switch (code) {
    case control::Command::Nothing:
      return {};
    case control::Command::Start:
      if (arguments.empty()) return {control::Refusal::BadArguments};
      return model_.start((arguments[0] & control::kStartLockStep) != 0,
                          (arguments[0] & control::kStartCold) != 0);
    case control::Command::Stop:
      return model_.stop();
    case control::Command::TransferBegin: {
      if (arguments.size() != 2 + control::kDigestRegisters) return {control::Refusal::BadArguments};
      std::array<std::byte, 32> digest{};
      control::get_bytes(arguments.subspan(2), digest);
      return model_.begin_transfer(control::get32(arguments, 0), digest);
    }
    case control::Command::TransferCommit:
      return model_.commit();
    case control::Command::TransferAbort:
      return model_.abort();
    case control::Command::WriteBits:
    case control::Command::Force:
    case control::Command::Unforce:
      if (arguments.size() != kBitsArguments) return {control::Refusal::BadArguments};
      return model_.change_bits(code, control::get32(arguments, 0), control::get64(arguments, 2),
                                control::get64(arguments, 6));
    case control::Command::ClearRetained:
      return {model_.state() == control::State::Running ? control::Refusal::NotStopped
                                                        : control::Refusal::Done};
  }
  return {control::Refusal::UnknownCommand};
}

std::span<const std::byte> ControlRegisters::identification(std::uint8_t object) const {
  static constexpr std::array<std::string_view, 3> kTexts = {"Stepwright", "simulated controller", "1"};
  if (object >= kTexts.size()) return {};
  return std::as_bytes(std::span(kTexts[object].data(), kTexts[object].size()));
}

}  // namespace stepwright::support

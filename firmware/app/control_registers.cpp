#include "firmware/app/control_registers.h"

#include <array>

#include "runtime/modbus/pdu/wire.h"

namespace stepwright::app {

namespace control = modbus::control;
using modbus::pdu::Exception;

namespace {

// Registers from `first` on, `count` of them.
struct Block {
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  bool holds(std::uint32_t address) const { return address >= first && address < first + count; }
  bool holds(std::uint32_t address, std::uint32_t wanted) const {
    return holds(address) && address + wanted <= first + count;
  }
};

constexpr Block kStatus{control::status::kFirst, control::status::kCount};
constexpr Block kWindow{control::window::kFirst, control::window::kCount};
constexpr Block kOutputs{control::outputs::kFirst, control::kMaxRead};

constexpr Block kCommand{control::command::kFirst, control::command::kMaxCount};
constexpr Block kTransfer{control::transfer::kFirst, control::kMaxWrite};
constexpr Block kSelect{control::select::kFirst, control::select::kCount};
constexpr Block kInputs{control::inputs::kFirst, control::kMaxWriteInRw};

void put_words(std::span<const std::uint16_t> from, std::span<std::byte> words) {
  for (std::size_t i = 0; i * 2 < words.size(); ++i) modbus::pdu::put16(words, i * 2, from[i]);
}

}  // namespace

Exception ControlRegisters::may_read(std::uint16_t address, std::uint16_t count) {
  for (const Block& block : {kStatus, kWindow, kOutputs}) {
    if (block.holds(address, count)) return Exception::None;
  }
  return Exception::IllegalDataAddress;
}

void ControlRegisters::read(std::uint16_t address, std::uint16_t count, std::span<std::byte> words) {
  std::array<std::uint16_t, control::kMaxRead> block{};
  std::uint16_t first = kOutputs.first;
  if (kStatus.holds(address)) {
    fill_status(controller_, std::span(block).first<control::status::kCount>());
    first = kStatus.first;
  } else if (kWindow.holds(address)) {
    fill_window(controller_, selection_, std::span(block).first<control::window::kCount>());
    first = kWindow.first;
  } else {
    fill_outputs(controller_, block);
  }
  put_words(std::span(block).subspan(address - first, count), words);
}

Exception ControlRegisters::write(std::uint16_t address, std::uint16_t count,
                                  std::span<const std::byte> words) {
  const Block* block = nullptr;
  for (const Block* each : {&kCommand, &kTransfer, &kSelect, &kInputs}) {
    if (each->holds(address)) block = each;
  }
  if (block == nullptr) return Exception::IllegalDataAddress;
  if (address != block->first || count > block->count) return Exception::IllegalDataValue;
  std::array<std::uint16_t, control::kMaxWrite> values;
  for (std::size_t i = 0; i < count; ++i) values[i] = modbus::pdu::get16(words, i * 2);
  const auto written = std::span<const std::uint16_t>(values).first(count);
  if (block == &kCommand) return command(written);
  if (block == &kTransfer) return piece(written);
  if (block == &kSelect) return select(written);
  return inputs(written);
}

Exception ControlRegisters::command(std::span<const std::uint16_t> words) {
  CommandWords command;
  if (words.size() < control::command::kArguments) return Exception::IllegalDataValue;
  command.number = words[control::command::kNumber];
  if (command.number == 0) return Exception::IllegalDataValue;
  command.count = static_cast<std::uint16_t>(words.size());
  for (std::size_t i = 0; i < words.size(); ++i) command.words[i] = words[i];
  return controller_.submit(command);
}

Exception ControlRegisters::piece(std::span<const std::uint16_t> words) {
  namespace transfer = control::transfer;
  if (words.size() <= transfer::kData) return Exception::IllegalDataValue;
  const std::uint16_t bytes = words[transfer::kBytes];
  if (bytes == 0 || std::size_t{transfer::kData} + (bytes + 1u) / 2 != words.size())
    return Exception::IllegalDataValue;
  std::array<std::byte, transfer::kMaxBytes> data;
  const auto piece = std::span(data).first(bytes);
  control::get_bytes(words.subspan(transfer::kData), piece);
  return controller_.piece(control::get32(words, transfer::kOffset), piece);
}

Exception ControlRegisters::select(std::span<const std::uint16_t> words) {
  if (words.size() != control::select::kCount) return Exception::IllegalDataValue;
  const std::uint16_t what = words[control::select::kWhat];
  if (what > static_cast<std::uint16_t>(control::Memory::Program)) return Exception::IllegalDataValue;
  selection_ = {static_cast<control::Memory>(what), control::get32(words, control::select::kOffset)};
  return Exception::None;
}

// Fewer bytes than the program has inputs leave the others as they are.
Exception ControlRegisters::inputs(std::span<const std::uint16_t> words) {
  const std::uint16_t turn = words[control::inputs::kTurn];
  const auto data = words.subspan(control::inputs::kData);
  const std::size_t most = controller_.machine().inputs().size();
  if (turn == 0 || data.size() > (most + 1) / 2) return Exception::IllegalDataValue;
  std::array<std::byte, control::inputs::kMaxBytes> bytes;
  const auto inputs = std::span(bytes).first(data.size() * 2 < most ? data.size() * 2 : most);
  control::get_bytes(data, inputs);
  controller_.exchange(turn, inputs);
  return Exception::None;
}

}  // namespace stepwright::app

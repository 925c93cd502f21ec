#include "runtime/host/output_drivers.h"

#include <algorithm>

#include "runtime/bytecode/boolean_pair.h"
#include "runtime/bytecode/instruction.h"

namespace stepwright::host {
namespace {

using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::Section;

// Bytes that a store to an absolute address writes; 0 for any other instruction.
std::uint32_t stored_bytes(Opcode opcode) {
  switch (opcode) {
    case Opcode::StoreBoolAbs:
    case Opcode::StoreI8Abs:
    case Opcode::StoreU8Abs:
      return 1;
    case Opcode::StoreI16Abs:
    case Opcode::StoreU16Abs:
      return 2;
    case Opcode::StoreI32Abs:
    case Opcode::StoreF32Abs:
    case Opcode::StoreRefAbs:
      return 4;
    case Opcode::StoreI64Abs:
    case Opcode::StoreF64Abs:
      return 8;
    default:
      return 0;
  }
}

class Collector {
 public:
  explicit Collector(const bytecode::SizesRecord& sizes)
      : first_(sizes.input_bytes), bits_(sizes.output_bytes) {}

  void add(const Instruction& instruction) {
    if (bytecode::is_boolean_pair(instruction.opcode)) {
      for (const Instruction& each : bytecode::unfold(instruction)) add(each);
    } else if (instruction.opcode == Opcode::StoreBit) {
      add(instruction.a, 1, static_cast<std::uint8_t>(1u << instruction.b));
    } else if (instruction.opcode == Opcode::AddrAbs) {
      if (instruction.a >= first_) add(instruction.a, bits_.bytes(), 0xFF);
    } else if (const std::uint32_t bytes = stored_bytes(instruction.opcode); bytes > 0) {
      add(instruction.a, bytes, 0xFF);
    }
  }

  OutputBits take() { return std::move(bits_); }

 private:
  void add(std::uint32_t address, std::size_t count, std::uint8_t mask) {
    if (address >= first_) bits_.add(address - first_, count, mask);
  }

  std::uint32_t first_;
  OutputBits bits_;
};

}  // namespace

void OutputBits::add(std::size_t byte, std::size_t count, std::uint8_t mask) {
  const std::size_t end = std::min(masks_.size(), byte + count);
  for (std::size_t i = byte; i < end; ++i) masks_[i] |= mask;
}

OutputBits written_outputs(const bytecode::Program& program,
                           const std::function<bool(std::uint32_t)>& counts) {
  const bytecode::ContainerView& view = program.container();
  Collector collector(program.sizes());
  for (std::uint32_t f = 0; f < view.count<Section::Functions>(); ++f) {
    if (counts && !counts(f)) continue;
    const auto code = view.code(view.record<Section::Functions>(f));
    Instruction instruction;
    for (std::uint32_t pc = 0; pc < code.size(); pc += instruction.size) {
      if (!bytecode::decode(code, pc, instruction)) break;  // not in a verified program
      collector.add(instruction);
    }
  }
  return collector.take();
}

}  // namespace stepwright::host

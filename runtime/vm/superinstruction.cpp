#include "runtime/vm/superinstruction.h"

#include <cassert>

#include "runtime/bytecode/instruction.h"

namespace stepwright::vm {

using bytecode::FunctionRecord;
using bytecode::Instruction;
using bytecode::Opcode;
using bytecode::Section;

namespace {

constexpr auto kQuickNames = std::to_array<const char*>({
#define STEPWRIGHT_X(name, ...) #name,
    STEPWRIGHT_QUICK_ORIGINALS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
});

constexpr bool same(const char* x, const char* y) {
  for (; *x == *y; ++x, ++y) {
    if (*x == '\0') return true;
  }
  return false;
}

// The quick number of each opcode.
constexpr auto kQuickOf = [] {
  std::array<Quick, bytecode::kOpcodeCount> numbers{};
  for (std::uint32_t opcode = 0; opcode < bytecode::kOpcodeCount; ++opcode) {
    numbers[opcode] = Quick::Original;
    for (std::uint32_t i = 0; i < kQuickNames.size(); ++i) {
      if (same(kQuickNames[i], bytecode::kOpcodes[opcode].name)) numbers[opcode] = static_cast<Quick>(i);
    }
  }
  return numbers;
}();

// Whether any superinstruction starts with each opcode.
constexpr auto kStarts = [] {
  std::array<bool, bytecode::kOpcodeCount> starts{};
  for (const Superinstruction& each : kSuperinstructions)
    starts[static_cast<std::uint8_t>(each.parts[0])] = true;
  return starts;
}();

// An array that a handler may reach without asking again.
bool elements_within(const Instruction& address, const Instruction& index, const FunctionRecord& function) {
  constexpr std::uint32_t kElementBytes = 4;
  const auto elements = static_cast<std::uint64_t>(std::int64_t{index.signed_b()} - index.signed_a()) + 1;
  return index.c == kElementBytes && address.a + elements * kElementBytes <= function.instance_size;
}

bool matches(const Superinstruction& super, std::span<const std::byte> code, const FunctionRecord& function) {
  std::uint32_t pc = 0;
  Instruction address;
  for (std::uint32_t part = 0; part < super.count; ++part) {
    Instruction in;
    if (pc >= code.size() || static_cast<Opcode>(code[pc]) != super.parts[part]) return false;
    if (!bytecode::decode(code, pc, in)) return false;
    if (in.opcode == Opcode::AddrThis) address = in;
    if (in.opcode == Opcode::Index && super.elements != Elements::None &&
        !elements_within(address, in, function))
      return false;
    pc += in.size;
  }
  return true;
}

// The longest superinstruction that starts here, else the instruction itself.
Quick best(Opcode first, std::span<const std::byte> code, const FunctionRecord& function) {
  Quick number = kQuickOf[static_cast<std::uint8_t>(first)];
  if (!kStarts[static_cast<std::uint8_t>(first)]) return number;
  std::uint32_t most = 1;
  for (const Superinstruction& super : kSuperinstructions) {
    if (super.count <= most || !matches(super, code, function)) continue;
    most = super.count;
    number = super.number;
  }
  return number;
}

}  // namespace

void quicken(const bytecode::Program& program, std::span<std::byte> code) {
  const bytecode::ContainerView& view = program.container();
  assert(code.size() >= view.section(Section::Code).size());
  for (std::uint32_t f = 0; f < view.count<Section::Functions>(); ++f) {
    const FunctionRecord function = view.record<Section::Functions>(f);
    const std::span<const std::byte> from = view.code(function);
    std::byte* const to = code.data() + function.code_offset;
    Instruction in;
    for (std::uint32_t pc = 0; pc < from.size() && bytecode::decode(from, pc, in); pc += in.size) {
      to[pc] = static_cast<std::byte>(best(in.opcode, from.subspan(pc), function));
      for (std::uint32_t i = 1; i < in.size; ++i) to[pc + i] = from[pc + i];
    }
  }
}

}  // namespace stepwright::vm

#pragma once

// The quick form of a program's code: what the interpreter runs if it is given memory for it.
// It is the code of the file with other opcodes and the same operands at the same places, so that every
// instruction keeps its pc. Where the parts of a superinstruction follow each other, its number stands in
// place of the first part's opcode; its handler does the work of all and goes on behind the last. The other
// parts stay what they are: a jump to one of them finds it there. Traps, their places and the budget are
// therefore those of the parts.
//
// Numbers are bytes. The frequent instructions have one of their own, every other one is Original: the
// interpreter looks it up in the file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/bytecode/opcode.h"
#include "runtime/bytecode/program.h"
#include "runtime/vm/superinstruction_list.h"

namespace stepwright::vm {

enum class Quick : std::uint8_t {
#define STEPWRIGHT_X(name, ...) name,
  STEPWRIGHT_QUICK_ORIGINALS(STEPWRIGHT_X) STEPWRIGHT_SUPERINSTRUCTIONS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
      Original
};

// The memory type of the array elements that a superinstruction reaches itself: their stride must be its
// size, and the array must lie within the instance.
enum class Elements : std::uint8_t { None, I32, F32 };

inline constexpr std::uint32_t kMostParts = 12;

struct Superinstruction {
  const char* name;
  Quick number;
  Elements elements;
  std::uint8_t count = 0;
  std::array<bytecode::Opcode, kMostParts> parts{};

  // Bytes from the first part to this one; of part `count`: to the end.
  constexpr std::uint32_t offset(std::uint32_t part) const {
    std::uint32_t bytes = 0;
    for (std::uint32_t i = 0; i < part; ++i) bytes += bytecode::instruction_size(parts[i]);
    return bytes;
  }
};

namespace internal {

template <typename... Parts>
constexpr Superinstruction make_super(const char* name, Quick number, Elements elements, Parts... parts) {
  static_assert(sizeof...(parts) <= kMostParts);
  return {name, number, elements, sizeof...(parts), {parts...}};
}

constexpr auto make_superinstructions() {
  using enum bytecode::Opcode;
  return std::to_array<Superinstruction>({
#define STEPWRIGHT_X(name, elements, ...) make_super(#name, Quick::name, Elements::elements, __VA_ARGS__),
      STEPWRIGHT_SUPERINSTRUCTIONS(STEPWRIGHT_X)
#undef STEPWRIGHT_X
  });
}

}  // namespace internal

inline constexpr auto kSuperinstructions = internal::make_superinstructions();
inline constexpr std::uint32_t kFirstSuper = static_cast<std::uint32_t>(kSuperinstructions[0].number);
inline constexpr std::uint32_t kQuickCount = static_cast<std::uint32_t>(Quick::Original) + 1;
static_assert(kFirstSuper + kSuperinstructions.size() + 1 == kQuickCount && kQuickCount <= 256);

constexpr const Superinstruction& superinstruction(Quick number) {
  return kSuperinstructions[static_cast<std::uint32_t>(number) - kFirstSuper];
}

// Writes the quick form of a program's code. Requires as many bytes as its Code section has.
void quicken(const bytecode::Program& program, std::span<std::byte> code);

}  // namespace stepwright::vm

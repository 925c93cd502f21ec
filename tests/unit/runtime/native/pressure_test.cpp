// More operands at once than there are registers, with a comparison in the flags on top of them: what is sent
// to its slot to make room must not spoil the comparison, nor the comparison it.

#include <gtest/gtest.h>

#include "tests/unit/runtime/native/engine_pair.h"

namespace stepwright::native {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using writer::FunctionBuilder;

constexpr std::uint32_t kNumbers = 0;  // ARRAY[0..7] OF DINT
constexpr std::uint32_t kIndexes = 32;
constexpr std::uint32_t kCompared = 96;
constexpr std::uint32_t kCounter = 100;
constexpr std::uint32_t kResult = 104;
constexpr std::uint32_t kBools = 128;  // ARRAY[0..7] OF BOOL, also written as bytes
constexpr std::uint32_t kDataBytes = 136;
constexpr int kMostOperands = 14;

void push_element(FunctionBuilder& f, MemType type, std::uint32_t array, int index) {
  f.addr_abs(array);
  f.load(MemType::I32, AddressMode::Abs, kIndexes + 4 * static_cast<std::uint32_t>(index));
  f.index(0, 7, size_of(type));
  f.load(type, AddressMode::Ind);
}

void compare(FunctionBuilder& f) {
  f.load(MemType::I32, AddressMode::Abs, kCompared);
  f.const_i32(3);
  f.emit(Opcode::GtI32);
}

void add_numbers(FunctionBuilder& f, int operands) {
  for (int i = 0; i < operands; ++i) push_element(f, MemType::I32, kNumbers, i);
  compare(f);
  f.emit(Opcode::BoolToI32);
  for (int i = 0; i < operands; ++i) f.emit(Opcode::AddI32);
  f.store(MemType::I32, AddressMode::Abs, kResult);
}

// The store changes what the operands below have not read yet, with the comparison between.
void join_bools(FunctionBuilder& f, int operands) {
  for (int i = 0; i < operands; ++i) push_element(f, MemType::Bool, kBools, i);
  compare(f);
  f.const_i32(2);
  f.store(MemType::U8, AddressMode::Abs, kBools + 3);
  for (int i = 0; i < operands; ++i) {
    f.emit(Opcode::BoolToI32);
    f.store(MemType::I32, AddressMode::Abs, kResult + 4);
    f.load(MemType::I32, AddressMode::Abs, kResult);
    f.const_i32(2);
    f.emit(Opcode::MulI32);
    f.load(MemType::I32, AddressMode::Abs, kResult + 4);
    f.emit(Opcode::AddI32);
    f.store(MemType::I32, AddressMode::Abs, kResult);
  }
  f.store(MemType::Bool, AddressMode::Abs, kResult + 8);
}

// Twice, so that the loop keeps variables in registers.
template <typename Body>
void twice(FunctionBuilder& f, Body body) {
  const auto start = f.new_label();
  f.bind(start);
  body();
  f.load(MemType::I32, AddressMode::Abs, kCounter);
  f.const_i32(1);
  f.emit(Opcode::SubI32);
  f.store(MemType::I32, AddressMode::Abs, kCounter);
  f.load(MemType::I32, AddressMode::Abs, kCounter);
  f.emit(Opcode::I32ToBool);
  f.jump_if_true(start);
}

void expect_agreement(bool bools, bool in_loop, int operands) {
  const auto body = [&](FunctionBuilder& f) { bools ? join_bools(f, operands) : add_numbers(f, operands); };
  EnginePair pair(support::one_program(
      kDataBytes, [&](FunctionBuilder& f) { in_loop ? twice(f, [&] { body(f); }) : body(f); }));
  for (std::int32_t compared = 2; compared < 6; ++compared) {
    for (std::uint32_t i = 0; i < 8; ++i) {
      pair.write<std::int32_t>(kNumbers + 4 * i, 100 << i);
      pair.write<std::uint8_t>(kBools + i, static_cast<std::uint8_t>(0x9C >> i & 1));
    }
    for (std::uint32_t i = 0; i < kMostOperands; ++i)
      pair.write<std::uint32_t>(kIndexes + 4 * i, (i * 3 + static_cast<std::uint32_t>(compared)) % 8);
    pair.write(kCompared, compared);
    pair.write<std::int32_t>(kCounter, 2);
    EXPECT_EQ(pair.run(), "") << operands << " operands, " << compared << (bools ? ", BOOL" : "")
                              << (in_loop ? ", in a loop" : "");
    EXPECT_FALSE(pair.trap());
  }
}

TEST(Pressure, Operands_WhenTheyAreMoreThanRegisters_ThenAComparisonOnTopSurvives) {
  if (!NativeEngine::supported()) GTEST_SKIP() << "one engine only";
  for (const bool bools : {false, true}) {
    for (const bool in_loop : {false, true}) {
      for (int operands = 0; operands <= kMostOperands; ++operands)
        expect_agreement(bools, in_loop, operands);
    }
  }
}

}  // namespace
}  // namespace stepwright::native

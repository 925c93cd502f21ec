// Loads, stores, references and copies.

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "tests/support/test_program.h"

namespace stepwright::vm {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
using support::one_program;
using support::TestProgram;
using writer::FunctionBuilder;

constexpr MemType kAllTypes[] = {MemType::Bool, MemType::I8,  MemType::U8,  MemType::I16, MemType::U16,
                                 MemType::I32,  MemType::I64, MemType::F32, MemType::F64, MemType::Ref};

// Copies a value of every type from the first to the second half of the instance in one address mode.
class Copies : public ::testing::TestWithParam<AddressMode> {
 protected:
  static void address(FunctionBuilder& f, AddressMode mode, std::uint32_t offset) {
    if (mode == AddressMode::Ind) f.addr_this(offset);
  }
};

TEST_P(Copies, LoadAndStore_WhenPaired_ThenKeepTheBytes) {
  const AddressMode mode = GetParam();
  for (const MemType type : kAllTypes) {
    TestProgram program(one_program(16, [&](FunctionBuilder& f) {
      address(f, mode, 8);
      address(f, mode, 0);
      f.load(type, mode, 0);
      f.store(type, mode, 8);
    }));
    const std::uint64_t pattern = type == MemType::Bool ? 1 : 0x8182838485868788u;
    program.write(0, pattern);
    ASSERT_FALSE(program.run());
    const std::uint32_t bits = 8 * size_of(type);
    const std::uint64_t mask = bits == 64 ? ~0ull : (1ull << bits) - 1;
    EXPECT_EQ(program.read<std::uint64_t>(8), pattern & mask) << static_cast<int>(type);
  }
}

INSTANTIATE_TEST_SUITE_P(AllModes, Copies,
                         ::testing::Values(AddressMode::Abs, AddressMode::This, AddressMode::Ind));

TEST(Memory, SmallIntegers_WhenLoaded_ThenAreExtendedByTheirSign) {
  TestProgram program(one_program(24, [](FunctionBuilder& f) {
    const MemType types[] = {MemType::I8, MemType::U8, MemType::I16, MemType::U16};
    for (std::uint32_t i = 0; i < 4; ++i) {
      f.load(types[i], AddressMode::Abs, 0);
      f.store(MemType::I32, AddressMode::Abs, 4 + 4 * i);
    }
  }));
  program.write<std::uint16_t>(0, 0xFEFD);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int32_t>(4), -3);
  EXPECT_EQ(program.read<std::int32_t>(8), 0xFD);
  EXPECT_EQ(program.read<std::int32_t>(12), -259);
  EXPECT_EQ(program.read<std::int32_t>(16), 0xFEFD);
}

TEST(Memory, Bool_WhenAByteIsNeitherZeroNorOne_ThenLoadsAsTrue) {
  TestProgram program(one_program(4, [](FunctionBuilder& f) {
    f.load(MemType::Bool, AddressMode::Abs, 0);
    f.emit(Opcode::NotBool);
    f.store(MemType::Bool, AddressMode::Abs, 1);
  }));
  program.write<std::uint8_t>(0, 0x40);
  program.write<std::uint8_t>(1, 1);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::uint8_t>(1), 0);
}

TEST(Memory, Bits_WhenStored_ThenTheOthersStay) {
  TestProgram program(one_program(4, [](FunctionBuilder& f) {
    f.load_bit(0, 7);
    f.store_bit(1, 3);
    f.load_bit(0, 0);
    f.store_bit(1, 0);
  }));
  program.write<std::uint8_t>(0, 0x80);
  program.write<std::uint8_t>(1, 0x21);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::uint8_t>(1), 0x28);
}

// table[index] := 7 with lower bound -2, upper bound 1, INT elements at offset 4.
writer::ContainerModel indexed_store() {
  return one_program(16, [](FunctionBuilder& f) {
    f.addr_this(4);
    f.load(MemType::I32, AddressMode::This, 0);
    f.index(-2, 1, 2);
    f.const_i32(7);
    f.store(MemType::I16, AddressMode::Ind);
  });
}

TEST(Memory, Index_WhenWithinBounds_ThenNamesTheElement) {
  for (const std::int32_t index : {-2, -1, 0, 1}) {
    TestProgram program(indexed_store());
    program.write<std::int32_t>(0, index);
    ASSERT_FALSE(program.run());
    EXPECT_EQ(program.read<std::int16_t>(static_cast<std::uint32_t>(4 + 2 * (index + 2))), 7);
  }
}

TEST(Memory, Index_WhenOutOfBounds_ThenTrapsAtTheInstruction) {
  for (const std::int32_t index : {-3, 2, INT32_MIN, INT32_MAX}) {
    TestProgram program(indexed_store());
    program.write<std::int32_t>(0, index);
    const bytecode::Trap trap = program.run();
    EXPECT_EQ(trap.code, TrapCode::IndexRange);
    EXPECT_EQ(trap.function, 0u);
    EXPECT_EQ(trap.pc, 10u);  // behind AddrThis and LoadI32This
    EXPECT_EQ(program.read<std::int64_t>(4), 0);
  }
}

TEST(Memory, Reference_WhenNullOrOutside_ThenTrapsForLoadStoreCopyAndCall) {
  FunctionBuilder block("FB", bytecode::FunctionKind::FunctionBlock, 8);
  block.emit(Opcode::Return);
  const writer::Function fb = std::move(block).take();
  const std::vector<std::function<void(FunctionBuilder&)>> uses = {
      [](FunctionBuilder& f) {
        f.load(MemType::Ref, AddressMode::This, 0);
        f.load(MemType::I32, AddressMode::Ind);
        f.emit(Opcode::Drop);
      },
      [](FunctionBuilder& f) {
        f.load(MemType::Ref, AddressMode::This, 0);
        f.const_i32(1);
        f.store(MemType::I32, AddressMode::Ind);
      },
      [](FunctionBuilder& f) {
        f.load(MemType::Ref, AddressMode::This, 0);
        f.addr_this(4);
        f.mem_copy(4);
      },
      [](FunctionBuilder& f) {
        f.addr_this(4);
        f.load(MemType::Ref, AddressMode::This, 0);
        f.mem_copy(4);
      },
      [](FunctionBuilder& f) {
        f.load(MemType::Ref, AddressMode::This, 0);
        f.call_instance(AddressMode::Ind, 1);
      }};
  for (const auto& use : uses) {
    for (const std::uint32_t reference : {bytecode::kNullRef, 16u, 13u, 0xFFFFFFFEu}) {
      TestProgram program(one_program(16, use, {fb}));
      program.write(0, reference);
      const bool null = reference == bytecode::kNullRef;
      EXPECT_EQ(program.run().code, null ? TrapCode::NullReference : TrapCode::BadReference) << reference;
    }
    TestProgram good(one_program(16, use, {fb}));
    good.write(0, 8u);
    EXPECT_FALSE(good.run());
  }
}

TEST(Memory, Reference_WhenOffsetBeyond32Bits_ThenIsStoredAsNull) {
  TestProgram program(one_program(16, [](FunctionBuilder& f) {
    f.load(MemType::Ref, AddressMode::This, 0);
    f.offset(16);
    f.store(MemType::Ref, AddressMode::This, 4);
  }));
  program.write(0, 0xFFFFFFFEu);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::uint32_t>(4), bytecode::kNullRef);
}

TEST(Memory, Copy_WhenRangesOverlap_ThenTheSourceArrivesWhole) {
  TestProgram program(one_program(12, [](FunctionBuilder& f) {
    f.addr_this(2);
    f.addr_this(0);
    f.mem_copy(8);
  }));
  program.write<std::uint64_t>(0, 0x0807060504030201u);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::uint64_t>(2), 0x0807060504030201u);
}

TEST(Memory, Locals_WhenTheFunctionStarts_ThenAreZeroEachTime) {
  TestProgram program(one_program(4, [](FunctionBuilder& f) {
    const auto local = f.add_local(StackType::I32);
    f.local_get(local);
    f.const_i32(5);
    f.emit(Opcode::AddI32);
    f.local_set(local);
    f.local_get(local);
    f.store(MemType::I32, AddressMode::This, 0);
  }));
  for (int scan = 0; scan < 3; ++scan) {
    ASSERT_FALSE(program.run());
    EXPECT_EQ(program.read<std::int32_t>(0), 5);
  }
}

}  // namespace
}  // namespace stepwright::vm

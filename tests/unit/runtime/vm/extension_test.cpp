// Fused booleans, subranges, references, dynamic arrays, frames and elementary functions.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "tests/support/test_program.h"

namespace stepwright::vm {
namespace {

using bytecode::AddressMode;
using bytecode::IntrinsicId;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
using support::one_program;
using support::TestProgram;
using writer::FunctionBuilder;

using BoolFunction = bool (*)(bool, bool);

struct FusedCase {
  Opcode operation;
  bool negate;
  BoolFunction expected;
  Opcode fused;
};
constexpr FusedCase kFused[] = {
    {Opcode::AndBool, false, [](bool x, bool y) { return x && y; }, Opcode::AndBoolAbs},
    {Opcode::OrBool, false, [](bool x, bool y) { return x || y; }, Opcode::OrBoolAbs},
    {Opcode::XorBool, false, [](bool x, bool y) { return x != y; }, Opcode::XorBoolAbs},
    {Opcode::AndBool, true, [](bool x, bool y) { return x && !y; }, Opcode::AndNotBoolAbs},
    {Opcode::OrBool, true, [](bool x, bool y) { return x || !y; }, Opcode::OrNotBoolAbs},
};

TEST(FusedBoolean, Operations_WhenOperandsAreInMemory_ThenAgreeWithTheTruthTable) {
  for (const FusedCase& each : kFused) {
    for (const AddressMode mode : {AddressMode::Abs, AddressMode::This}) {
      const auto emit = [&](FunctionBuilder& f) {
        f.load(MemType::Bool, mode, 0);
        f.line(0, 1);  // keeps it from becoming one with the load (boolean_pair_test.cpp)
        f.load(MemType::Bool, mode, 1);
        if (each.negate) f.emit(Opcode::NotBool);
        f.emit(each.operation);
        f.line(0, 2);
        f.store(MemType::Bool, mode, 2);
      };
      auto model = one_program(3, emit);
      model.source_files = {"f.st"};
      const auto number = static_cast<std::uint8_t>(each.fused) + (mode == AddressMode::This ? 1 : 0);
      ASSERT_EQ(std::to_integer<int>(model.functions[0].code[5]), number);
      for (int bits = 0; bits < 4; ++bits) {
        TestProgram program(model);
        program.write<std::uint8_t>(0, bits & 1);
        program.write<std::uint8_t>(1, bits & 2);  // any byte but 0 is TRUE
        ASSERT_FALSE(program.run());
        EXPECT_EQ(program.read<std::uint8_t>(2), each.expected((bits & 1) != 0, (bits & 2) != 0) ? 1 : 0);
      }
    }
  }
}

TEST(FusedBoolean, NegatedLoad_WhenRun_ThenGivesTheOpposite) {
  for (const AddressMode mode : {AddressMode::Abs, AddressMode::This}) {
    TestProgram program(one_program(2, [&](FunctionBuilder& f) {
      f.load(MemType::Bool, mode, 0);
      f.emit(Opcode::NotBool);
      f.store(MemType::Bool, mode, 1);
    }));
    ASSERT_FALSE(program.run());
    EXPECT_EQ(program.read<std::uint8_t>(1), 1);
    program.write<std::uint8_t>(0, 8);
    ASSERT_FALSE(program.run());
    EXPECT_EQ(program.read<std::uint8_t>(1), 0);
  }
}

template <typename T>
TrapCode checked(MemType type, T value, const std::function<void(FunctionBuilder&)>& check) {
  TestProgram program(one_program(16, [&](FunctionBuilder& f) {
    f.load(type, AddressMode::This, 0);
    check(f);
    f.store(type, AddressMode::This, 8);
  }));
  program.write(0, value);
  const TrapCode code = program.run().code;
  EXPECT_EQ(program.read<T>(8), code == TrapCode::None ? value : T{0});
  return code;
}

TEST(Subrange, Values_WhenOutsideTheBounds_ThenTrapBeforeTheyAreStored) {
  for (const std::int32_t value : {-6, -5, 0, 10, 11}) {
    const TrapCode expected = value < -5 || value > 10 ? TrapCode::SubrangeRange : TrapCode::None;
    EXPECT_EQ(checked(MemType::I32, value, [](auto& f) { f.check_i32(-5, 10); }), expected);
    EXPECT_EQ(checked(MemType::I64, std::int64_t{value}, [](auto& f) { f.check_i64(-5, 10); }), expected);
  }
  const auto unsigned_check = [](auto& f) { f.check_u64(5, 0x8000000000000005u); };
  for (const std::uint64_t value :
       {std::uint64_t{4}, std::uint64_t{5}, 0x8000000000000005u, 0x8000000000000006u}) {
    const TrapCode expected =
        value < 5 || value > 0x8000000000000005u ? TrapCode::SubrangeRange : TrapCode::None;
    EXPECT_EQ(checked(MemType::I64, value, unsigned_check), expected);
  }
}

TEST(Reference, Equality_WhenCompared_ThenIsThatOfTheAddresses) {
  TestProgram program(one_program(16, [](FunctionBuilder& f) {
    const Opcode operations[] = {Opcode::EqRef, Opcode::NeRef};
    for (std::uint32_t i = 0; i < 2; ++i) {
      f.load(MemType::Ref, AddressMode::This, 0);
      f.emit(Opcode::ConstNull);
      f.emit(operations[i]);
      f.store(MemType::Bool, AddressMode::This, 4 + i);
    }
  }));
  program.write(0, bytecode::kNullRef);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::uint16_t>(4), 0x0001);
  program.write(0, 8u);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::uint16_t>(4), 0x0100);
}

TEST(Reference, Null_WhenFollowedWithAnOffset_ThenTrapsAsNull) {
  TestProgram program(one_program(16, [](FunctionBuilder& f) {
    f.emit(Opcode::ConstNull);
    f.offset(4);
    f.load(MemType::I32, AddressMode::Ind);
    f.store(MemType::I32, AddressMode::This, 0);
  }));
  EXPECT_EQ(program.run().code, TrapCode::NullReference);
}

TEST(DynamicArray, Index_WhenOutsideTheBoundsOnTheStack_ThenTraps) {
  TestProgram program(one_program(64, [](FunctionBuilder& f) {
    f.addr_this(16);
    for (std::uint32_t at = 0; at < 12; at += 4) f.load(MemType::I32, AddressMode::This, at);
    f.index_dyn(4);
    f.const_i32(99);
    f.store(MemType::I32, AddressMode::Ind);
  }));
  const auto run = [&](std::int32_t index) {
    program.write(0, index);
    program.write(4, std::int32_t{-2});
    program.write(8, std::int32_t{3});
    return program.run().code;
  };
  EXPECT_EQ(run(-2), TrapCode::None);
  EXPECT_EQ(program.read<std::int32_t>(16), 99);
  EXPECT_EQ(run(3), TrapCode::None);
  EXPECT_EQ(program.read<std::int32_t>(36), 99);
  EXPECT_EQ(run(-3), TrapCode::IndexRange);
  EXPECT_EQ(run(4), TrapCode::IndexRange);
}

// main writes its frame, calls a function that writes its own, and finds its own unchanged.
TEST(Frame, Memory_WhenCallerAndCalleeUseIt_ThenTheyDoNotShareIt) {
  FunctionBuilder callee("F", bytecode::FunctionKind::Function);
  const std::uint32_t inner = callee.allocate_frame(4, 4);
  callee.addr_frame(inner);
  callee.const_i32(222);
  callee.store(MemType::I32, AddressMode::Ind);
  callee.emit(Opcode::Return);
  TestProgram program(one_program(8,
                                  [](FunctionBuilder& f) {
                                    const std::uint32_t first = f.allocate_frame(1, 1);
                                    const std::uint32_t second = f.allocate_frame(4, 4);
                                    EXPECT_EQ(first, 0u);
                                    EXPECT_EQ(second, 4u);
                                    f.addr_frame(second);
                                    f.const_i32(111);
                                    f.store(MemType::I32, AddressMode::Ind);
                                    f.call(1);
                                    f.addr_frame(second);
                                    f.load(MemType::I32, AddressMode::Ind);
                                    f.store(MemType::I32, AddressMode::This, 0);
                                  },
                                  {std::move(callee).take()}));
  EXPECT_EQ(program.loaded().program().sizes().frame_bytes, 16u);
  EXPECT_EQ(program.loaded().program().memory_size(), 24u);
  const std::uint64_t hash = program.image().hash();
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int32_t>(0), 111);
  EXPECT_EQ(program.read<std::int32_t>(8 + 4), 111);
  EXPECT_EQ(program.read<std::int32_t>(8 + 8), 222);
  program.write(0, std::int32_t{0});
  EXPECT_EQ(program.image().hash(), hash) << "frames are no part of the image";
}

struct Function1 {
  IntrinsicId f32;
  IntrinsicId f64;
  double (*expected)(double);
};
const Function1 kFunctions[] = {
    {IntrinsicId::SinF32, IntrinsicId::SinF64, [](double x) { return std::sin(x); }},
    {IntrinsicId::CosF32, IntrinsicId::CosF64, [](double x) { return std::cos(x); }},
    {IntrinsicId::TanF32, IntrinsicId::TanF64, [](double x) { return std::tan(x); }},
    {IntrinsicId::AsinF32, IntrinsicId::AsinF64, [](double x) { return std::asin(x); }},
    {IntrinsicId::AcosF32, IntrinsicId::AcosF64, [](double x) { return std::acos(x); }},
    {IntrinsicId::AtanF32, IntrinsicId::AtanF64, [](double x) { return std::atan(x); }},
    {IntrinsicId::ExpF32, IntrinsicId::ExpF64, [](double x) { return std::exp(x); }},
    {IntrinsicId::LnF32, IntrinsicId::LnF64, [](double x) { return std::log(x); }},
    {IntrinsicId::LogF32, IntrinsicId::LogF64, [](double x) { return std::log10(x); }},
};

template <typename T>
struct Outcome {
  TrapCode trap;
  T value;
};

template <typename T>
Outcome<T> call(IntrinsicId id, std::vector<T> arguments) {
  constexpr MemType kType = sizeof(T) == 4 ? MemType::F32 : MemType::F64;
  TestProgram program(one_program(24, [&](FunctionBuilder& f) {
    for (std::uint32_t i = 0; i < arguments.size(); ++i) f.load(kType, AddressMode::This, 8 * i);
    f.intrinsic(id);
    f.store(kType, AddressMode::This, 16);
  }));
  for (std::uint32_t i = 0; i < arguments.size(); ++i) program.write(8 * i, arguments[i]);
  const TrapCode trap = program.run().code;
  return {trap, program.read<T>(16)};
}

TEST(Elementary, Functions_WhenCalled_ThenAreThoseOfTheLibrary) {
  for (const Function1& each : kFunctions) {
    for (const double x : {0.25, 0.5, 1.0}) {
      EXPECT_EQ(call<double>(each.f64, {x}).value, each.expected(x));
      EXPECT_EQ(call<float>(each.f32, {static_cast<float>(x)}).value, static_cast<float>(each.expected(x)));
    }
  }
  EXPECT_EQ(call<double>(IntrinsicId::Atan2F64, {1.0, -2.0}).value, std::atan2(1.0, -2.0));
  EXPECT_EQ(call<float>(IntrinsicId::Atan2F32, {1.0f, -2.0f}).value,
            static_cast<float>(std::atan2(1.0, -2.0)));
  EXPECT_EQ(call<double>(IntrinsicId::PowF64, {2.0, 0.5}).value, std::pow(2.0, 0.5));
  EXPECT_EQ(call<float>(IntrinsicId::PowF32, {-2.0f, 3.0f}).value, -8.0f);
}

TEST(Elementary, Functions_WhenOutsideTheirDomain_ThenTrap) {
  const auto trap = [](IntrinsicId id, std::vector<double> arguments) {
    return call<double>(id, arguments).trap;
  };
  EXPECT_EQ(trap(IntrinsicId::LnF64, {0.0}), TrapCode::BadArgument);
  EXPECT_EQ(trap(IntrinsicId::LnF64, {-1.0}), TrapCode::BadArgument);
  EXPECT_EQ(trap(IntrinsicId::LogF64, {0.0}), TrapCode::BadArgument);
  EXPECT_EQ(trap(IntrinsicId::AsinF64, {1.0000001}), TrapCode::BadArgument);
  EXPECT_EQ(trap(IntrinsicId::AcosF64, {-1.0000001}), TrapCode::BadArgument);
  EXPECT_EQ(trap(IntrinsicId::PowF64, {0.0, -1.0}), TrapCode::BadArgument);
  EXPECT_EQ(trap(IntrinsicId::PowF64, {-8.0, 1.0 / 3.0}), TrapCode::BadArgument);
  EXPECT_EQ(call<float>(IntrinsicId::LnF32, {0.0f}).trap, TrapCode::BadArgument);
  EXPECT_EQ(call<float>(IntrinsicId::PowF32, {-8.0f, 0.5f}).trap, TrapCode::BadArgument);
  EXPECT_EQ(trap(IntrinsicId::ExpF64, {1e9}), TrapCode::None);
  EXPECT_TRUE(std::isnan(call<double>(IntrinsicId::LnF64, {std::numeric_limits<double>::quiet_NaN()}).value));
}

}  // namespace
}  // namespace stepwright::vm

// Each instruction by what it leaves in the image.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>

#include "tests/support/test_program.h"

namespace stepwright::vm {
namespace {

using bytecode::AddressMode;
using bytecode::IntrinsicId;
using bytecode::IntType;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::TrapCode;
using support::one_program;
using support::TestProgram;
using writer::FunctionBuilder;

template <typename T>
constexpr MemType memory_of() {
  if constexpr (std::is_same_v<T, bool>) return MemType::Bool;
  if constexpr (std::is_integral_v<T> && sizeof(T) == 4) return MemType::I32;
  if constexpr (std::is_integral_v<T> && sizeof(T) == 8) return MemType::I64;
  if constexpr (std::is_same_v<T, float>) return MemType::F32;
  return MemType::F64;
}

template <typename T>
void push(FunctionBuilder& f, T value) {
  if constexpr (std::is_same_v<T, bool>) {
    f.const_bool(value);
  } else if constexpr (std::is_same_v<T, float>) {
    f.const_f32(value);
  } else if constexpr (std::is_same_v<T, double>) {
    f.const_f64(value);
  } else if constexpr (sizeof(T) == 4) {
    f.const_i32(static_cast<std::int32_t>(value));
  } else {
    f.const_i64(static_cast<std::int64_t>(value));
  }
}

// The result of `emit` behind these operands, or the trap that it ends in.
template <typename R>
struct Outcome {
  R value{};
  TrapCode trap = TrapCode::None;
};

template <typename R, typename Emit, typename... Args>
Outcome<R> evaluate(Emit emit, Args... args) {
  TestProgram program(one_program(8, [&](FunctionBuilder& f) {
    (push(f, args), ...);
    emit(f);
    f.store(memory_of<R>(), AddressMode::Abs, 0);
  }));
  const auto trap = program.run();
  return {program.read<R>(0), trap.code};
}

template <typename R, typename... Args>
R result_of(Opcode opcode, Args... args) {
  const auto outcome = evaluate<R>([&](FunctionBuilder& f) { f.emit(opcode); }, args...);
  EXPECT_EQ(outcome.trap, TrapCode::None) << bytecode::info(opcode).name;
  return outcome.value;
}

template <typename R, typename... Args>
TrapCode trap_of(Opcode opcode, Args... args) {
  return evaluate<R>([&](FunctionBuilder& f) { f.emit(opcode); }, args...).trap;
}

using i32 = std::int32_t;
using u32 = std::uint32_t;
using i64 = std::int64_t;
using u64 = std::uint64_t;

TEST(Instruction, IntegerArithmetic_WhenItOverflows_ThenWraps) {
  EXPECT_EQ(result_of<i32>(Opcode::AddI32, INT32_MAX, 1), INT32_MIN);
  EXPECT_EQ(result_of<i32>(Opcode::SubI32, 3, 5), -2);
  EXPECT_EQ(result_of<i32>(Opcode::MulI32, 65536, 65536), 0);
  EXPECT_EQ(result_of<i32>(Opcode::NegI32, INT32_MIN), INT32_MIN);
  EXPECT_EQ(result_of<i64>(Opcode::AddI64, i64{INT64_MAX}, i64{1}), INT64_MIN);
  EXPECT_EQ(result_of<i64>(Opcode::SubI64, i64{-3}, i64{5}), -8);
  EXPECT_EQ(result_of<i64>(Opcode::MulI64, i64{-3}, i64{5}), -15);
  EXPECT_EQ(result_of<i64>(Opcode::NegI64, i64{7}), -7);
}

TEST(Instruction, Division_WhenSignsDiffer_ThenTruncatesTowardsZero) {
  EXPECT_EQ(result_of<i32>(Opcode::DivI32, -7, 2), -3);
  EXPECT_EQ(result_of<i32>(Opcode::DivI32, INT32_MIN, -1), INT32_MIN);
  EXPECT_EQ(result_of<i32>(Opcode::ModI32, -7, 2), -1);
  EXPECT_EQ(result_of<u32>(Opcode::DivU32, 0x80000000u, 2u), 0x40000000u);
  EXPECT_EQ(result_of<u32>(Opcode::ModU32, 0xFFFFFFFFu, 10u), 5u);
  EXPECT_EQ(result_of<i64>(Opcode::DivI64, i64{INT64_MIN}, i64{-1}), INT64_MIN);
  EXPECT_EQ(result_of<u64>(Opcode::DivU64, ~u64{0}, u64{2}), ~u64{0} / 2);
  EXPECT_EQ(result_of<i64>(Opcode::ModI64, i64{-7}, i64{4}), -3);
  EXPECT_EQ(result_of<u64>(Opcode::ModU64, ~u64{0}, u64{10}), 5u);
}

TEST(Instruction, Division_WhenByZero_ThenTraps) {
  EXPECT_EQ(trap_of<i32>(Opcode::DivI32, 1, 0), TrapCode::DivisionByZero);
  EXPECT_EQ(trap_of<i32>(Opcode::DivU32, 1, 0), TrapCode::DivisionByZero);
  EXPECT_EQ(trap_of<i64>(Opcode::DivI64, i64{1}, i64{0}), TrapCode::DivisionByZero);
  EXPECT_EQ(trap_of<i64>(Opcode::DivU64, i64{1}, i64{0}), TrapCode::DivisionByZero);
  EXPECT_EQ(trap_of<float>(Opcode::DivF32, 1.0f, -0.0f), TrapCode::DivisionByZero);
  EXPECT_EQ(trap_of<double>(Opcode::DivF64, 1.0, 0.0), TrapCode::DivisionByZero);
  EXPECT_EQ(result_of<i32>(Opcode::ModI32, 5, 0), 0);
}

TEST(Instruction, FloatArithmetic_WhenExact_ThenIsIeee) {
  EXPECT_EQ(result_of<float>(Opcode::AddF32, 0.1f, 0.2f), 0.1f + 0.2f);
  EXPECT_EQ(result_of<float>(Opcode::SubF32, 1.0f, 0.25f), 0.75f);
  EXPECT_EQ(result_of<float>(Opcode::MulF32, 3.0f, 0.5f), 1.5f);
  EXPECT_EQ(result_of<float>(Opcode::DivF32, 1.0f, 3.0f), 1.0f / 3.0f);
  EXPECT_EQ(result_of<float>(Opcode::NegF32, 2.0f), -2.0f);
  EXPECT_EQ(result_of<double>(Opcode::AddF64, 0.1, 0.2), 0.1 + 0.2);
  EXPECT_EQ(result_of<double>(Opcode::SubF64, 0.3, 0.1), 0.3 - 0.1);
  EXPECT_EQ(result_of<double>(Opcode::MulF64, 0.1, 3.0), 0.1 * 3.0);
  EXPECT_EQ(result_of<double>(Opcode::DivF64, 1.0, 3.0), 1.0 / 3.0);
  EXPECT_EQ(result_of<double>(Opcode::NegF64, -2.5), 2.5);
}

TEST(Instruction, Wrap_WhenBitsAreAbove_ThenKeepsTheLowOnes) {
  EXPECT_EQ(result_of<i32>(Opcode::WrapI8, 200), -56);
  EXPECT_EQ(result_of<i32>(Opcode::WrapU8, -1), 255);
  EXPECT_EQ(result_of<i32>(Opcode::WrapI16, 40000), -25536);
  EXPECT_EQ(result_of<i32>(Opcode::WrapU16, -1), 65535);
}

TEST(Instruction, Logic_WhenOnBooleans_ThenFollowsTheTruthTables) {
  for (const bool x : {false, true}) {
    EXPECT_EQ(result_of<bool>(Opcode::NotBool, x), !x);
    for (const bool y : {false, true}) {
      EXPECT_EQ(result_of<bool>(Opcode::AndBool, x, y), x && y);
      EXPECT_EQ(result_of<bool>(Opcode::OrBool, x, y), x || y);
      EXPECT_EQ(result_of<bool>(Opcode::XorBool, x, y), x != y);
    }
  }
}

TEST(Instruction, Logic_WhenOnBitStrings_ThenIsBitwise) {
  EXPECT_EQ(result_of<u32>(Opcode::AndI32, 0xF0F0u, 0xFF00u), 0xF000u);
  EXPECT_EQ(result_of<u32>(Opcode::OrI32, 0xF0F0u, 0x0F00u), 0xFFF0u);
  EXPECT_EQ(result_of<u32>(Opcode::XorI32, 0xFFFFFFFFu, 0x1u), 0xFFFFFFFEu);
  EXPECT_EQ(result_of<u32>(Opcode::NotI32, 0u), 0xFFFFFFFFu);
  EXPECT_EQ(result_of<u64>(Opcode::AndI64, ~u64{0}, u64{7}), 7u);
  EXPECT_EQ(result_of<u64>(Opcode::OrI64, u64{1} << 40, u64{7}), (u64{1} << 40) | 7);
  EXPECT_EQ(result_of<u64>(Opcode::XorI64, ~u64{0}, u64{7}), ~u64{7});
  EXPECT_EQ(result_of<u64>(Opcode::NotI64, u64{0}), ~u64{0});
}

// The complement of an I32 must leave a clean high half, or a widening afterwards would show it.
TEST(Instruction, Not_WhenWidenedAfterwards_ThenHasNoStrayBits) {
  const auto outcome = evaluate<u64>(
      [](FunctionBuilder& f) {
        f.emit(Opcode::NotI32);
        f.emit(Opcode::U32ToI64);
      },
      0u);
  EXPECT_EQ(outcome.value, 0xFFFFFFFFu);
}

TEST(Instruction, Shifts_WhenCountIsInOrOutOfRange_ThenAreDefined) {
  EXPECT_EQ(result_of<u32>(Opcode::ShlI32, 1u, 4), 16u);
  EXPECT_EQ(result_of<u32>(Opcode::ShrI32, 0x80000000u, 31), 1u);
  EXPECT_EQ(result_of<u32>(Opcode::ShrI32, 0x80000000u, -1), 0u);
  EXPECT_EQ(result_of<u64>(Opcode::ShlI64, u64{1}, 40), u64{1} << 40);
  EXPECT_EQ(result_of<u64>(Opcode::ShrI64, ~u64{0}, 64), 0u);
  EXPECT_EQ(result_of<u64>(Opcode::RolI64, u64{1} << 63, 1), 1u);
  EXPECT_EQ(result_of<u64>(Opcode::RorI64, u64{1}, 65), u64{1} << 63);
  const auto rol8 = evaluate<u32>([](FunctionBuilder& f) { f.rotate_i32(Opcode::RolI32, 8); }, 0x81u, 1);
  EXPECT_EQ(rol8.value, 0x03u);
  const auto ror16 = evaluate<u32>([](FunctionBuilder& f) { f.rotate_i32(Opcode::RorI32, 16); }, 0x0001u, 17);
  EXPECT_EQ(ror16.value, 0x8000u);
}

template <typename T>
void expect_order(Opcode lt, Opcode le, Opcode gt, Opcode ge, T small, T large) {
  EXPECT_TRUE(result_of<bool>(lt, small, large));
  EXPECT_FALSE(result_of<bool>(lt, large, large));
  EXPECT_TRUE(result_of<bool>(le, large, large));
  EXPECT_FALSE(result_of<bool>(le, large, small));
  EXPECT_TRUE(result_of<bool>(gt, large, small));
  EXPECT_FALSE(result_of<bool>(gt, small, small));
  EXPECT_TRUE(result_of<bool>(ge, small, small));
  EXPECT_FALSE(result_of<bool>(ge, small, large));
}

TEST(Instruction, Comparisons_WhenSignedOrUnsigned_ThenOrderByTheirType) {
  expect_order<i32>(Opcode::LtI32, Opcode::LeI32, Opcode::GtI32, Opcode::GeI32, -1, 1);
  expect_order<u32>(Opcode::LtU32, Opcode::LeU32, Opcode::GtU32, Opcode::GeU32, 1, 0xFFFFFFFF);
  expect_order<i64>(Opcode::LtI64, Opcode::LeI64, Opcode::GtI64, Opcode::GeI64, -1, 1);
  expect_order<u64>(Opcode::LtU64, Opcode::LeU64, Opcode::GtU64, Opcode::GeU64, 1, ~u64{0});
  expect_order<float>(Opcode::LtF32, Opcode::LeF32, Opcode::GtF32, Opcode::GeF32, -1.5f, 0.5f);
  expect_order<double>(Opcode::LtF64, Opcode::LeF64, Opcode::GtF64, Opcode::GeF64, -1.5, 0.5);
  EXPECT_TRUE(result_of<bool>(Opcode::EqI32, 4, 4));
  EXPECT_TRUE(result_of<bool>(Opcode::NeI64, i64{4}, i64{5}));
  EXPECT_FALSE(result_of<bool>(Opcode::EqI64, i64{4}, i64{4} << 32));
  EXPECT_FALSE(result_of<bool>(Opcode::NeI32, 4, 4));
  const float nan32 = std::numeric_limits<float>::quiet_NaN();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(result_of<bool>(Opcode::EqF64, nan, nan));
  EXPECT_TRUE(result_of<bool>(Opcode::NeF64, nan, nan));
  EXPECT_FALSE(result_of<bool>(Opcode::LeF32, nan32, 0.0f));
  EXPECT_TRUE(result_of<bool>(Opcode::EqF32, 0.0f, -0.0f));
  EXPECT_TRUE(result_of<bool>(Opcode::NeF32, nan32, nan32));
}

TEST(Instruction, Conversions_WhenInRange_ThenKeepTheValue) {
  EXPECT_EQ(result_of<i32>(Opcode::BoolToI32, true), 1);
  EXPECT_TRUE(result_of<bool>(Opcode::I32ToBool, 256));
  EXPECT_TRUE(result_of<bool>(Opcode::I64ToBool, i64{1} << 32));
  EXPECT_EQ(result_of<i64>(Opcode::I32ToI64, -5), -5);
  EXPECT_EQ(result_of<i64>(Opcode::U32ToI64, -5), 4294967291);
  EXPECT_EQ(result_of<i32>(Opcode::I64ToI32, (i64{1} << 32) + 3), 3);
  EXPECT_EQ(result_of<float>(Opcode::I32ToF32, -7), -7.0f);
  EXPECT_EQ(result_of<float>(Opcode::U32ToF32, 0xFFFFFFFFu), 4294967296.0f);
  EXPECT_EQ(result_of<float>(Opcode::I64ToF32, i64{-7}), -7.0f);
  EXPECT_EQ(result_of<float>(Opcode::U64ToF32, u64{1} << 63), 9223372036854775808.0f);
  EXPECT_EQ(result_of<double>(Opcode::I32ToF64, -7), -7.0);
  EXPECT_EQ(result_of<double>(Opcode::U32ToF64, 0xFFFFFFFFu), 4294967295.0);
  EXPECT_EQ(result_of<double>(Opcode::I64ToF64, i64{-7}), -7.0);
  EXPECT_EQ(result_of<double>(Opcode::U64ToF64, u64{1} << 63), 9223372036854775808.0);
  EXPECT_EQ(result_of<double>(Opcode::F32ToF64, 0.1f), static_cast<double>(0.1f));
  EXPECT_EQ(result_of<float>(Opcode::F64ToF32, 0.1), 0.1f);
  EXPECT_EQ(trap_of<float>(Opcode::F64ToF32, 1e300), TrapCode::ConversionRange);
  EXPECT_TRUE(std::isinf(result_of<float>(Opcode::F64ToF32, std::numeric_limits<double>::infinity())));
}

TEST(Instruction, ToInteger_WhenHalfWayOrOutOfRange_ThenRoundsToEvenOrTraps) {
  const auto to_int = [](Opcode opcode, IntType type) {
    return [=](FunctionBuilder& f) { f.to_int(opcode, type); };
  };
  EXPECT_EQ(evaluate<i32>(to_int(Opcode::RoundF32, IntType::I16), 2.5f).value, 2);
  EXPECT_EQ(evaluate<i32>(to_int(Opcode::RoundF32, IntType::I16), 3.5f).value, 4);
  EXPECT_EQ(evaluate<i32>(to_int(Opcode::RoundF64, IntType::I32), -0.5).value, 0);
  EXPECT_EQ(evaluate<i32>(to_int(Opcode::TruncF32, IntType::I32), -2.9f).value, -2);
  EXPECT_EQ(evaluate<i64>(to_int(Opcode::TruncF64, IntType::I64), 1e15 + 0.5).value, 1'000'000'000'000'000);
  EXPECT_EQ(evaluate<u32>(to_int(Opcode::RoundF64, IntType::U32), 4294967295.4).value, 0xFFFFFFFFu);
  EXPECT_EQ(evaluate<i32>(to_int(Opcode::RoundF32, IntType::I16), 32767.6f).trap, TrapCode::ConversionRange);
  EXPECT_EQ(evaluate<i32>(to_int(Opcode::TruncF32, IntType::U8), -1.0f).trap, TrapCode::ConversionRange);
  EXPECT_EQ(evaluate<i32>(to_int(Opcode::RoundF64, IntType::I32), std::nan("")).trap,
            TrapCode::ConversionRange);
}

TEST(Instruction, Intrinsics_WhenCalled_ThenGiveExactResults) {
  const auto call = [](IntrinsicId id) { return [=](FunctionBuilder& f) { f.intrinsic(id); }; };
  EXPECT_EQ(evaluate<i32>(call(IntrinsicId::AbsI32), -5).value, 5);
  EXPECT_EQ(evaluate<i32>(call(IntrinsicId::AbsI32), INT32_MIN).value, INT32_MIN);
  EXPECT_EQ(evaluate<i64>(call(IntrinsicId::AbsI64), i64{-5}).value, 5);
  EXPECT_EQ(evaluate<float>(call(IntrinsicId::AbsF32), -5.5f).value, 5.5f);
  EXPECT_EQ(evaluate<double>(call(IntrinsicId::AbsF64), -5.5).value, 5.5);
  EXPECT_EQ(evaluate<float>(call(IntrinsicId::SqrtF32), 2.0f).value, std::sqrt(2.0f));
  EXPECT_EQ(evaluate<double>(call(IntrinsicId::SqrtF64), 2.0).value, std::sqrt(2.0));
  EXPECT_EQ(evaluate<double>(call(IntrinsicId::SqrtF64), -1.0).trap, TrapCode::BadArgument);
  EXPECT_EQ(evaluate<i32>(call(IntrinsicId::MinI32), -1, 2).value, -1);
  EXPECT_EQ(evaluate<u32>(call(IntrinsicId::MinU32), -1, 2).value, 2u);
  EXPECT_EQ(evaluate<i32>(call(IntrinsicId::MaxI32), -1, 2).value, 2);
  EXPECT_EQ(evaluate<u32>(call(IntrinsicId::MaxU32), -1, 2).value, 0xFFFFFFFFu);
  EXPECT_EQ(evaluate<i64>(call(IntrinsicId::MinI64), i64{-1}, i64{2}).value, -1);
  EXPECT_EQ(evaluate<u64>(call(IntrinsicId::MinU64), i64{-1}, i64{2}).value, 2u);
  EXPECT_EQ(evaluate<i64>(call(IntrinsicId::MaxI64), i64{-1}, i64{2}).value, 2);
  EXPECT_EQ(evaluate<u64>(call(IntrinsicId::MaxU64), i64{-1}, i64{2}).value, ~u64{0});
  EXPECT_EQ(evaluate<float>(call(IntrinsicId::MinF32), 1.0f, -2.0f).value, -2.0f);
  EXPECT_EQ(evaluate<float>(call(IntrinsicId::MaxF32), 1.0f, -2.0f).value, 1.0f);
  EXPECT_EQ(evaluate<double>(call(IntrinsicId::MinF64), 1.0, 2.0).value, 1.0);
  EXPECT_EQ(evaluate<double>(call(IntrinsicId::MaxF64), 1.0, 2.0).value, 2.0);
}

TEST(Instruction, Select_WhenConditionHolds_ThenGivesTheSecondValue) {
  EXPECT_EQ(result_of<double>(Opcode::Select, 1.5, 2.5, true), 2.5);
  EXPECT_EQ(result_of<double>(Opcode::Select, 1.5, 2.5, false), 1.5);
}

TEST(Instruction, DupAndDrop_WhenUsed_ThenCopyAndRemoveTheTop) {
  const auto outcome = evaluate<i32>(
      [](FunctionBuilder& f) {
        f.emit(Opcode::Dup);
        f.emit(Opcode::AddI32);
        f.const_f64(1.0);
        f.emit(Opcode::Drop);
      },
      21);
  EXPECT_EQ(outcome.value, 42);
}

}  // namespace
}  // namespace stepwright::vm

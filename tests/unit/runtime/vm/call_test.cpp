// Calls, instances, budget and time.

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "tests/support/sample_model.h"
#include "tests/support/test_program.h"

namespace stepwright::vm {
namespace {

using bytecode::AddressMode;
using bytecode::FunctionKind;
using bytecode::MemType;
using bytecode::Opcode;
using bytecode::StackType;
using bytecode::TrapCode;
using support::one_program;
using support::TestProgram;
using writer::FunctionBuilder;

// SUB3(a, b, c) := a - b - t, where t is a local set to c.
writer::Function subtract_all() {
  FunctionBuilder f("SUB3", FunctionKind::Function);
  const auto a = f.add_param(StackType::I32);
  const auto b = f.add_param(StackType::I64);
  const auto c = f.add_param(StackType::I32);
  const auto t = f.add_local(StackType::I32);
  f.set_result(StackType::I32);
  f.local_get(c);
  f.local_set(t);
  f.local_get(a);
  f.local_get(b);
  f.emit(Opcode::I64ToI32);
  f.emit(Opcode::SubI32);
  f.local_get(t);
  f.emit(Opcode::SubI32);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

// A block that counts its calls in a DINT.
writer::Function counter() {
  FunctionBuilder f("COUNTER", FunctionKind::FunctionBlock, 4);
  f.load(MemType::I32, AddressMode::This, 0);
  f.const_i32(1);
  f.emit(Opcode::AddI32);
  f.store(MemType::I32, AddressMode::This, 0);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

TEST(Call, Function_WhenCalledWithOperandsBelow_ThenTakesItsOwnOnly) {
  TestProgram program(one_program(4,
                                  [](FunctionBuilder& f) {
                                    f.const_i32(1000);
                                    f.const_i32(100);
                                    f.const_i64(20);
                                    f.const_i32(3);
                                    f.call(1);
                                    f.emit(Opcode::SubI32);
                                    f.store(MemType::I32, AddressMode::This, 0);
                                  },
                                  {subtract_all()}));
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int32_t>(0), 1000 - 77);
}

TEST(Call, Procedure_WhenItHasNoResult_ThenLeavesTheStackAlone) {
  FunctionBuilder nothing("NOTHING", FunctionKind::Function);
  nothing.add_param(StackType::I32);
  nothing.emit(Opcode::Return);
  std::vector<writer::Function> more;
  more.push_back(std::move(nothing).take());
  TestProgram program(one_program(
      4,
      [](FunctionBuilder& f) {
        f.const_i32(5);
        f.const_i32(6);
        f.call(1);
        f.store(MemType::I32, AddressMode::This, 0);
      },
      std::move(more)));
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int32_t>(0), 5);
}

TEST(Call, Instances_WhenCalledInAllModes_ThenEachKeepsItsOwnData) {
  TestProgram program(one_program(16,
                                  [](FunctionBuilder& f) {
                                    f.call_instance(AddressMode::Abs, 1, 0);
                                    f.call_instance(AddressMode::This, 1, 4);
                                    f.call_instance(AddressMode::This, 1, 4);
                                    f.addr_this(8);
                                    f.call_instance(AddressMode::Ind, 1);
                                    f.load(MemType::I32, AddressMode::This, 4);  // `this` is MAIN's again
                                    f.store(MemType::I32, AddressMode::This, 12);
                                  },
                                  {counter()}));
  ASSERT_FALSE(program.run());
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int32_t>(0), 2);
  EXPECT_EQ(program.read<std::int32_t>(4), 4);
  EXPECT_EQ(program.read<std::int32_t>(8), 2);
  EXPECT_EQ(program.read<std::int32_t>(12), 4);
}

TEST(Call, Trap_WhenInsideACallee_ThenNamesTheCalleeAndItsInstruction) {
  FunctionBuilder bad("BAD", FunctionKind::Function);
  bad.const_i32(1);
  bad.emit(Opcode::Drop);
  bad.trap(static_cast<std::uint8_t>(TrapCode::UserTrap));
  std::vector<writer::Function> more;
  more.push_back(std::move(bad).take());
  TestProgram program(one_program(
      4, [](FunctionBuilder& f) { f.call(1); }, std::move(more)));
  const bytecode::Trap trap = program.run();
  EXPECT_EQ(trap.code, TrapCode::UserTrap);
  EXPECT_EQ(trap.function, 1u);
  EXPECT_EQ(trap.pc, 6u);
  EXPECT_EQ(program.run().pc, 6u);  // a trap leaves nothing behind on the stack
}

// WHILE TRUE DO n := n + 1; END_WHILE
writer::ContainerModel endless_loop() {
  return one_program(4, [](FunctionBuilder& f) {
    const auto head = f.new_label();
    f.bind(head);
    f.load(MemType::I32, AddressMode::This, 0);
    f.const_i32(1);
    f.emit(Opcode::AddI32);
    f.store(MemType::I32, AddressMode::This, 0);
    f.jump(head);
  });
}

TEST(Budget, Loop_WhenEndless_ThenTrapsAfterTheSameNumberOfRounds) {
  std::int32_t rounds = 0;
  for (int attempt = 0; attempt < 2; ++attempt) {
    TestProgram program(endless_loop());
    std::uint64_t budget = 100'000;
    const bytecode::Trap trap = program.run(0, budget);
    EXPECT_EQ(trap.code, TrapCode::Watchdog);
    EXPECT_EQ(trap.pc, 16u);  // the jump
    EXPECT_GT(program.read<std::int32_t>(0), 1000);
    const auto counted = program.read<std::int32_t>(0);
    EXPECT_EQ(counted, attempt == 0 ? counted : rounds);
    rounds = counted;
  }
}

TEST(Budget, Loop_WhenEachJumpIsCharged_ThenTheDistanceIsTheCost) {
  TestProgram program(endless_loop());
  const auto code_size =
      program.loaded().program().container().record<bytecode::Section::Functions>(0).code_size;
  // Entry, then ten jumps of 21 bytes; the eleventh is one byte short.
  std::uint64_t budget = code_size + 10 * 21 + 20;
  EXPECT_EQ(program.run(0, budget).code, TrapCode::Watchdog);
  EXPECT_EQ(program.read<std::int32_t>(0), 11);
  EXPECT_EQ(budget, 20u);
}

TEST(Budget, Calls_WhenTheyUseItUp_ThenTrapAtTheCaller) {
  TestProgram program(
      one_program(4, [](FunctionBuilder& f) { f.call_instance(AddressMode::This, 1, 0); }, {counter()}));
  std::uint64_t budget = 12;
  const bytecode::Trap trap = program.run(0, budget);
  EXPECT_EQ(trap.code, TrapCode::Watchdog);
  EXPECT_EQ(trap.function, 0u);
  EXPECT_EQ(trap.pc, 0u);
  std::uint64_t none = 0;
  EXPECT_EQ(program.run(0, none).code, TrapCode::Watchdog);
}

TEST(Budget, Copy_WhenLarge_ThenIsCharged) {
  TestProgram program(one_program(1024, [](FunctionBuilder& f) {
    f.addr_this(512);
    f.addr_this(0);
    f.mem_copy(512);
  }));
  std::uint64_t budget = 16 + 31;
  EXPECT_EQ(program.run(0, budget).code, TrapCode::Watchdog);
  budget = 16 + 32;
  EXPECT_FALSE(program.run(0, budget));
  EXPECT_EQ(budget, 0u);
}

TEST(Time, Now_WhenRead_ThenIsTheTaskTime) {
  TestProgram program(one_program(8, [](FunctionBuilder& f) {
    f.emit(Opcode::Now);
    f.store(MemType::I64, AddressMode::This, 0);
  }));
  ASSERT_FALSE(program.run(123'456'789'012));
  EXPECT_EQ(program.read<std::int64_t>(0), 123'456'789'012);
}

TEST(Sample, Timer_WhenStartIsHeld_ThenPumpFollowsAfterItsTime) {
  using L = support::SampleLayout;
  TestProgram program(support::sample_model());
  const auto run_main = [&](std::int64_t now_ms) {
    std::uint64_t budget = 10'000;
    return program.engine().run({0, L::kMain, now_ms * 1'000'000}, program.image().memory(), budget);
  };
  program.write<std::uint8_t>(L::kInputs, 1);
  program.write<std::int16_t>(L::kInputs + 2, 40);
  for (std::int64_t now_ms = 0; now_ms <= 50; now_ms += 10) {
    if (now_ms == 0) program.write<std::uint8_t>(L::kInputs, 0);
    if (now_ms == 10) program.write<std::uint8_t>(L::kInputs, 1);
    ASSERT_FALSE(run_main(now_ms));
    EXPECT_EQ(program.read<std::uint8_t>(L::kOutputs) & 1, now_ms >= 30 ? 1 : 0) << now_ms;
  }
  EXPECT_EQ(program.read<float>(L::kMain + L::kLevel), 10.0f);
  EXPECT_EQ(program.read<std::int16_t>(L::kMain + L::kHistory + 2), 40);
}

}  // namespace
}  // namespace stepwright::vm

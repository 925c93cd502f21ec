// A run that does not come to an end is ended from another thread, in both engines.

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/unit/runtime/native/engine_pair.h"

namespace stepwright::native {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using writer::FunctionBuilder;

// Counts for ever while the BOOL at 4 is set; 1 + 2 at 8 afterwards.
writer::ContainerModel counting() {
  return support::one_program(12, [](FunctionBuilder& f) {
    const auto again = f.new_label();
    f.bind(again);
    f.load(MemType::I32, AddressMode::This, 0);
    f.const_i32(1);
    f.emit(bytecode::Opcode::AddI32);
    f.store(MemType::I32, AddressMode::This, 0);
    f.load(MemType::Bool, AddressMode::This, 4);
    f.jump_if_true(again);
    f.const_i32(3);
    f.store(MemType::I32, AddressMode::This, 8);
  });
}

// What one run of the engine does when it is asked to end after 20 ms; its budget would last for hours.
bytecode::Trap run_and_ask(bytecode::Engine& engine, bytecode::Interrupt& interrupt, EnginePair& pair,
                           std::uint64_t& budget) {
  interrupt.begin();
  std::thread monitor([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_TRUE(interrupt.ask(interrupt.running()));
  });
  const bytecode::Trap trap =
      engine.run({0, 0, 0, pair.loaded().program().frames_of(0)}, pair.native_image(), budget);
  monitor.join();
  interrupt.end();
  return trap;
}

TEST(Interrupt, WhenALoopDoesNotEnd_ThenTheRunTrapsAndTheNextOneIsFree) {
  EnginePair pair(counting());
  constexpr std::uint64_t kHours = std::uint64_t{1} << 60;
  for (bytecode::Engine* engine :
       {static_cast<bytecode::Engine*>(&pair.native()), static_cast<bytecode::Engine*>(&pair.quick())}) {
    pair.write<std::uint8_t>(4, 1);
    std::uint64_t budget = kHours;
    const bytecode::Trap trap = run_and_ask(*engine, pair.interrupt(), pair, budget);
    EXPECT_EQ(trap.code, bytecode::TrapCode::Watchdog);
    EXPECT_EQ(trap.function, 0u);
    EXPECT_GT(trap.pc, 0u);  // at the jump back
    EXPECT_LT(budget, kHours);
    EXPECT_GT(budget, kHours / 2);
    EXPECT_GT(pair.read<std::int32_t>(0), 1'000);  // it had run
    pair.reset(std::vector<std::byte>(pair.native_image().size()));
    EXPECT_EQ(pair.run(), "");
    EXPECT_EQ(pair.read<std::int32_t>(8), 3);
  }
}

TEST(Interrupt, WhenTheRunHasEnded_ThenAskingComesTooLate) {
  bytecode::Interrupt interrupt;
  interrupt.begin();
  const std::uint32_t first = interrupt.running();
  interrupt.end();
  EXPECT_EQ(interrupt.running(), 0u);
  EXPECT_FALSE(interrupt.ask(first));
  interrupt.begin();
  EXPECT_NE(interrupt.running(), first);
  EXPECT_FALSE(interrupt.ask(first));
  EXPECT_FALSE(interrupt.asked());
}

// Loops over many slices of the budget end as in one, at any budget around the edge of a slice.
TEST(Interrupt, WhenTheBudgetIsHandedOutInSlices_ThenTrapsAndWhatIsLeftAreTheSame) {
  EnginePair pair(counting());
  for (std::uint64_t budget = 3 * bytecode::kBudgetSlice - 40; budget < 3 * bytecode::kBudgetSlice + 40;
       ++budget) {
    pair.reset(std::vector<std::byte>(pair.native_image().size()));
    pair.write<std::uint8_t>(4, 1);
    EXPECT_EQ(pair.run(0, budget), "") << budget;
    EXPECT_EQ(pair.trap().code, bytecode::TrapCode::Watchdog);
  }
}

}  // namespace
}  // namespace stepwright::native

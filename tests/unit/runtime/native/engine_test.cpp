#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <string>

#include "tests/support/malloc_guard.h"
#include "tests/unit/runtime/native/engine_pair.h"
#include "tests/unit/runtime/native/random_program.h"

namespace stepwright::native {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using writer::FunctionBuilder;

struct Mappings {
  int writable_and_executable = 0;
  int executable_without_file = 0;
};

// A line of the file: "start-end rwxp offset device inode [path]".
Mappings mappings() {
  Mappings found;
  std::ifstream file("/proc/self/maps");
  for (std::string line; std::getline(file, line);) {
    const std::string rights = line.substr(line.find(' ') + 1, 4);
    if (rights[2] != 'x') continue;
    if (rights[1] == 'w') ++found.writable_and_executable;
    if (line.find('/') == std::string::npos && line.find('[') == std::string::npos) {
      ++found.executable_without_file;
    }
  }
  return found;
}

TEST(NativeEngine, WhenCodeIsMade_ThenNoPageIsWritableAndExecutable) {
  const auto loaded = support::TestProgram::load(random_program(1));
  const Mappings before = mappings();
  const auto engine = NativeEngine::compile(loaded.program());
  ASSERT_TRUE(engine);
  const Mappings during = mappings();
  EXPECT_EQ(during.writable_and_executable, 0);
  EXPECT_EQ(during.executable_without_file, before.executable_without_file + 1);
}

TEST(NativeEngine, WhenItGoes_ThenItsPagesGo) {
  const Mappings before = mappings();
  { EnginePair pair(random_program(1)); }
  EXPECT_EQ(mappings().executable_without_file, before.executable_without_file);
}

TEST(NativeEngine, WhenItRuns_ThenItNeitherAllocatesNorLocks) {
  if (!support::guard_is_active()) GTEST_SKIP() << "a sanitizer owns malloc";
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    EnginePair pair(random_program(seed));
    std::uint64_t budget = 100'000;
    const support::GuardCounts before = support::guard_counts();
    pair.native().run({0, 32, 0, pair.loaded().program().frames_of(0)}, pair.native_image(), budget);
    ASSERT_EQ(support::guard_counts(), before) << "seed " << seed;
  }
}

TEST(NativeEngine, WhenTheBudgetDoesNotCoverTheEntry_ThenTheProgramIsAtFault) {
  EnginePair pair(support::one_program(4, [](FunctionBuilder& f) {
    f.const_i32(1);
    f.store(MemType::I32, AddressMode::This, 0);
  }));
  EXPECT_EQ(pair.run(0, 3), "");
  EXPECT_EQ(pair.trap().code, bytecode::TrapCode::Watchdog);
  EXPECT_EQ(pair.read<std::int32_t>(0), 0);
}

// The loop keeps both variables in registers; the trap must find them in the image all the same.
TEST(NativeEngine, WhenALoopTraps_ThenItsVariablesAreInTheImage) {
  EnginePair pair(support::one_program(16, [](FunctionBuilder& f) {
    const auto start = f.new_label();
    f.bind(start);
    f.load(MemType::I32, AddressMode::This, 0);
    f.const_i32(1);
    f.emit(Opcode::AddI32);
    f.store(MemType::I32, AddressMode::This, 0);
    f.const_f32(10.0f);
    f.const_f32(5.0f);
    f.load(MemType::I32, AddressMode::This, 0);
    f.emit(Opcode::I32ToF32);
    f.emit(Opcode::SubF32);
    f.emit(Opcode::DivF32);
    f.store(MemType::F32, AddressMode::This, 4);
    f.jump(start);
  }));
  EXPECT_EQ(pair.run(), "");
  EXPECT_EQ(pair.trap().code, bytecode::TrapCode::DivisionByZero);
  EXPECT_EQ(pair.read<std::int32_t>(0), 5);
  EXPECT_EQ(pair.read<float>(4), 10.0f);
}

// The loop keeps the index in a register: one that was checked before it changed is checked again.
TEST(NativeEngine, WhenACheckedIndexChanges_ThenItIsCheckedAgain) {
  EnginePair pair(support::one_program(64, [](FunctionBuilder& f) {
    const auto start = f.new_label();
    const auto element = [&f](std::int32_t lower, std::int32_t upper) {
      f.addr_this(16);
      f.load(MemType::I32, AddressMode::This, 0);
      f.index(lower, upper, 4);
    };
    f.bind(start);
    element(0, 9);
    f.const_i32(7);
    f.store(MemType::I32, AddressMode::Ind);
    element(-1, 9);
    f.const_i32(8);
    f.store(MemType::I32, AddressMode::Ind);
    f.load(MemType::I32, AddressMode::This, 0);
    f.const_i32(1);
    f.emit(Opcode::AddI32);
    f.store(MemType::I32, AddressMode::This, 0);
    element(-1, 9);
    f.const_i32(9);
    f.store(MemType::I32, AddressMode::Ind);
    f.jump(start);
  }));
  EXPECT_EQ(pair.run(), "");
  EXPECT_EQ(pair.trap().code, bytecode::TrapCode::IndexRange);
  EXPECT_EQ(pair.read<std::int32_t>(0), 10);
}

// The first check lets more pass than the second.
TEST(NativeEngine, WhenAnIndexMeetsNarrowerBounds_ThenItIsCheckedAgain) {
  EnginePair pair(support::one_program(64, [](FunctionBuilder& f) {
    for (const std::int32_t upper : {9, 5}) {
      f.addr_this(16);
      f.load(MemType::I32, AddressMode::This, 0);
      f.index(0, upper, 4);
      f.const_i32(upper);
      f.store(MemType::I32, AddressMode::Ind);
    }
  }));
  pair.write<std::int32_t>(0, 6);
  EXPECT_EQ(pair.run(), "");
  EXPECT_EQ(pair.trap().code, bytecode::TrapCode::IndexRange);
  EXPECT_EQ(pair.read<std::int32_t>(40), 9);
}

// IF x > 100 THEN x := 100: without a branch in native code. Of a NaN the comparison is FALSE.
TEST(NativeEngine, WhenAConditionalStoreIsBranchFree_ThenItStoresOnlyWhereTheConditionHolds) {
  EnginePair pair(support::one_program(32, [](FunctionBuilder& f) {
    const auto store_if_above = [&f](MemType type, std::uint32_t at, const auto& push) {
      const auto behind = f.new_label();
      f.load(MemType::F32, AddressMode::This, 0);
      f.const_f32(100.0f);
      f.emit(Opcode::GtF32);
      f.jump_if_false(behind);
      push();
      f.store(type, AddressMode::This, at);
      f.bind(behind);
    };
    store_if_above(MemType::I16, 4, [&f] { f.const_i32(-2); });
    store_if_above(MemType::Bool, 6, [&f] { f.const_bool(true); });
    store_if_above(MemType::I64, 8, [&f] { f.emit(Opcode::Now); });
    store_if_above(MemType::F32, 0, [&f] { f.const_f32(100.0f); });
  }));
  for (const float x : {99.0f, std::numeric_limits<float>::quiet_NaN(), 101.0f}) {
    pair.write<float>(0, x);
    EXPECT_EQ(pair.run(77), "");
    const bool stored = x > 100.0f;
    EXPECT_EQ(pair.read<std::int16_t>(4), stored ? -2 : 0);
    EXPECT_EQ(pair.read<std::uint8_t>(6), stored ? 1 : 0);
    EXPECT_EQ(pair.read<std::int64_t>(8), stored ? 77 : 0);
  }
  EXPECT_EQ(pair.read<float>(0), 100.0f);
}

}  // namespace
}  // namespace stepwright::native

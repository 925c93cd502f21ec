#include <gtest/gtest.h>

#include <fstream>
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
  const Mappings before = mappings();
  EnginePair pair(random_program(1));
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

}  // namespace
}  // namespace stepwright::native

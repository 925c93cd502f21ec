#include "tests/support/engine_program/engine_program.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace stepwright::support {
namespace {

constexpr const char* kCounter = R"(PROGRAM main
VAR on : BOOL; count : INT; last : INT; END_VAR
IF on THEN count := count + 1; END_IF;
last := 100 / (5 - count);
END_PROGRAM
)";

TEST(EngineProgram, WhenItScans_ThenBothEnginesCountAlikeAndATrapEndsIt) {
  for (const EngineKind kind : {EngineKind::Native, EngineKind::Vm}) {
    EngineProgram program(compile_st(kCounter), kind);
    const reader::Variable count = program.variable("main.count");
    const auto counted = [&] { return reader::read_number(count, program.memory()); };
    EXPECT_TRUE(program.scan());
    EXPECT_EQ(counted(), 0.0);
    program.memory()[program.variable("MAIN.ON").address] = std::byte{1};
    for (int scan = 0; scan < 4; ++scan) EXPECT_TRUE(program.scan(scan));
    EXPECT_EQ(counted(), 4.0);
    EXPECT_FALSE(program.scan()) << "a division by zero";
    EXPECT_TRUE(program.trapped());
  }
}

TEST(EngineProgram, WhenAWatcherComesAlong_ThenItScansBehindTheProgram) {
  const driver::Watcher watcher{.name = "watch",
                                .text =
                                    "PROGRAM watch\nVAR seen : INT; END_VAR\nseen := "
                                    "main.count;\nEND_PROGRAM\n",
                                .outside_reads = 1};
  EngineProgram program(compile_st(kCounter, std::span(&watcher, 1)), EngineKind::Vm);
  program.memory()[program.variable("main.on").address] = std::byte{1};
  EXPECT_TRUE(program.scan());
  EXPECT_EQ(reader::read_number(program.variable("watch.seen"), program.memory()), 1.0);
}

TEST(EngineProgram, WhenItIsWrong_ThenItThrows) {
  EXPECT_THROW(compile_st("PROGRAM main\nnothing := 1;\nEND_PROGRAM\n"), std::runtime_error);
  const EngineProgram program(compile_st(kCounter), EngineKind::Vm);
  EXPECT_THROW((void)program.variable("main.none"), std::runtime_error);
}

}  // namespace
}  // namespace stepwright::support

#include "runtime/bytecode/writer/function_builder.h"

#include <gtest/gtest.h>

#include <utility>

#include "runtime/bytecode/instruction.h"
#include "tests/support/sample_model.h"
#include "tests/support/test_program.h"

namespace stepwright::writer {
namespace {

using bytecode::AddressMode;
using bytecode::FunctionKind;
using bytecode::MemType;
using bytecode::Opcode;

TEST(FunctionBuilder, Jump_WhenTheLabelIsBoundLater_ThenTheDistanceIsFilledIn) {
  FunctionBuilder f("F", FunctionKind::Function);
  const Label end = f.new_label();
  f.const_bool(true);
  f.jump_if_true(end);
  f.const_i32(1);
  f.emit(Opcode::Drop);
  f.bind(end);
  f.emit(Opcode::Return);
  const Function function = std::move(f).take();
  bytecode::Instruction in;
  ASSERT_TRUE(bytecode::decode(function.code, 2, in));
  EXPECT_EQ(in.opcode, Opcode::JumpIfTrue);
  EXPECT_EQ(in.signed_a(), 6);  // ConstI32 (5) and Drop (1)
}

TEST(FunctionBuilder, Code_WhenNothingReachesIt_ThenIsDropped) {
  FunctionBuilder f("F", FunctionKind::Function);
  f.emit(Opcode::Return);
  EXPECT_FALSE(f.reachable());
  f.const_i32(1);
  f.emit(Opcode::Return);
  EXPECT_EQ(std::move(f).take().code.size(), 1u);
}

TEST(FunctionBuilder, Loop_WhenTestedAtItsEnd_ThenRuns) {
  support::TestProgram program(support::one_program(4, [](FunctionBuilder& f) {
    const Label body = f.new_label();
    const Label test = f.new_label();
    f.jump(test);
    f.bind(body);
    f.load(MemType::I32, AddressMode::This, 0);
    f.const_i32(1);
    f.emit(Opcode::AddI32);
    f.store(MemType::I32, AddressMode::This, 0);
    f.bind(test);
    f.load(MemType::I32, AddressMode::This, 0);
    f.const_i32(10);
    f.emit(Opcode::LtI32);
    f.jump_if_true(body);
  }));
  EXPECT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int32_t>(0), 10);
}

TEST(FunctionBuilder, Constants_WhenFunctionsShareThem_ThenThePoolHoldsEachOnce) {
  FunctionBuilder other("OTHER", FunctionKind::Function);
  other.const_i64(5);
  other.emit(Opcode::Drop);
  other.const_i64(6);
  other.emit(Opcode::Drop);
  other.emit(Opcode::Return);
  std::vector<Function> more;
  more.push_back(std::move(other).take());
  support::TestProgram program(support::one_program(
      16,
      [](FunctionBuilder& f) {
        f.const_i64(6);
        f.store(MemType::I64, AddressMode::This, 0);
        f.const_i64(5);
        f.store(MemType::I64, AddressMode::This, 8);
      },
      std::move(more)));
  EXPECT_EQ(program.loaded().program().container().count<bytecode::Section::Constants>(), 2u);
  EXPECT_FALSE(program.run());
  EXPECT_EQ(program.read<std::int64_t>(0), 6);
  EXPECT_EQ(program.read<std::int64_t>(8), 5);
}

TEST(FunctionBuilder, Lines_WhenRepeatedOrEmpty_ThenAreMerged) {
  FunctionBuilder f("F", FunctionKind::Function);
  f.line(0, 1);
  f.line(0, 2);
  f.const_i32(1);
  f.line(0, 2);
  f.emit(Opcode::Drop);
  f.line(0, 3);
  f.emit(Opcode::Return);
  f.line(0, 9);
  const Function function = std::move(f).take();
  ASSERT_EQ(function.lines.size(), 2u);
  EXPECT_EQ(function.lines[0].line, 2u);
  EXPECT_EQ(function.lines[1].pc, 6u);
}

TEST(ContainerWriter, Model_WhenWrittenTwice_ThenTheBytesAreEqual) {
  EXPECT_EQ(write_container(support::sample_model()).value(),
            write_container(support::sample_model()).value());
}

TEST(ContainerWriter, Model_WhenATaskIsMissing_ThenIsRefusedWithAReason) {
  ContainerModel model = support::sample_model();
  model.tasks.clear();
  const auto bytes = write_container(model);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error()[0].code, "B0100");
}

}  // namespace
}  // namespace stepwright::writer

#include "ladder/codegen/generate.h"

#include <gtest/gtest.h>

#include "runtime/bytecode/instruction.h"
#include "tests/support/compiled_program.h"

namespace {

using namespace stepwright;
using bytecode::Opcode;

driver::CompileInput input_of(const std::string& text) {
  driver::CompileInput input;
  input.texts.push_back({"t.st", text});
  return input;
}

// The opcodes of the first function.
std::vector<Opcode> opcodes(const std::string& text) {
  const support::CompiledProgram program(input_of(text));
  const auto& container = program.loaded().program().container();
  const auto function = container.record<bytecode::Section::Functions>(0);
  const auto code = container.code(function);
  std::vector<Opcode> result;
  bytecode::Instruction instruction;
  for (std::uint32_t pc = 0; pc < code.size(); pc += instruction.size) {
    if (!bytecode::decode(code, pc, instruction)) break;
    result.push_back(instruction.opcode);
  }
  return result;
}

TEST(Generate, Logic_WhenOperatorsAreMixed_ThenThereIsNoBranch) {
  const auto code = opcodes(
      "PROGRAM main VAR a, b, c, d : BOOL; n : INT; END_VAR d := a AND (b OR NOT c) XOR (n > 3) AND SEL(a, "
      "b, c); "
      "END_PROGRAM");
  for (const Opcode each : code)
    EXPECT_TRUE(each != Opcode::Jump && each != Opcode::JumpIfFalse && each != Opcode::JumpIfTrue);
}

TEST(Generate, Store_WhenTheTargetIsMemory_ThenNoWrapIsNeeded) {
  const auto code = opcodes("PROGRAM main VAR i, j : INT; END_VAR i := i + j * 2 - 1; END_PROGRAM");
  for (const Opcode each : code) EXPECT_NE(each, Opcode::WrapI16);
  const auto compared = opcodes("PROGRAM main VAR i : INT; b : BOOL; END_VAR b := i + 1 > 5; END_PROGRAM");
  EXPECT_NE(std::find(compared.begin(), compared.end(), Opcode::WrapI16), compared.end());
}

TEST(Generate, Functions_WhenAPouIsNotUsed_ThenItIsLeftOut) {
  const support::CompiledProgram program(input_of(
      "FUNCTION unused : INT unused := 1; END_FUNCTION PROGRAM main VAR t : TON; END_VAR t(); END_PROGRAM"));
  EXPECT_EQ(program.loaded().program().container().count<bytecode::Section::Functions>(), 2u);
}

TEST(Generate, Retain_WhenNeighboursAreRetained_ThenTheMapJoinsThem) {
  const support::CompiledProgram program(input_of(
      "PROGRAM main VAR RETAIN a : INT; b : DINT; END_VAR VAR c : INT; END_VAR VAR RETAIN d : BOOL; END_VAR "
      "c := 1; END_PROGRAM"));
  const auto& container = program.loaded().program().container();
  ASSERT_EQ(container.count<bytecode::Section::RetainMap>(), 2u);
  EXPECT_EQ(container.record<bytecode::Section::RetainMap>(0).size, 6u);
  EXPECT_EQ(container.record<bytecode::Section::RetainMap>(1).size, 1u);
}

TEST(Generate, IoMap_WhenVariablesAreLocated_ThenListsTheirAddresses) {
  const support::CompiledProgram program(input_of(
      "VAR_GLOBAL level AT %IW1 : INT; END_VAR PROGRAM main VAR lamp AT %QX0.3 : BOOL; END_VAR lamp := level "
      "> 5; END_PROGRAM"));
  const auto& container = program.loaded().program().container();
  ASSERT_EQ(container.count<bytecode::Section::IoMap>(), 2u);
  EXPECT_EQ(program.loaded().program().sizes().input_bytes, 4u);
  EXPECT_EQ(program.loaded().program().sizes().output_bytes, 1u);
  EXPECT_EQ(program.find("level").address, 2u);
  EXPECT_EQ(program.find("main.lamp").bit, 3);
}

}  // namespace

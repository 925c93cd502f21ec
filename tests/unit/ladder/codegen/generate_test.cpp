#include "ladder/codegen/generate.h"

#include <gtest/gtest.h>

#include <optional>

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

TEST(Generate, For_WhenLimitAndStepAreConstant_ThenATurnIsOneTestAndOneAddition) {
  const auto code =
      opcodes("PROGRAM main VAR i, n : DINT; END_VAR FOR i := 1 TO 10 DO n := n + 1; END_FOR; END_PROGRAM");
  const std::vector<Opcode> expected = {
      Opcode::ConstI32, Opcode::StoreI32This, Opcode::LoadI32This, Opcode::ConstI32, Opcode::LeI32,
      Opcode::JumpIfFalse,
      // body
      Opcode::LoadI32This, Opcode::ConstI32, Opcode::AddI32, Opcode::StoreI32This,
      // turn
      Opcode::LoadI32This, Opcode::ConstI32, Opcode::GtI32, Opcode::LoadI32This, Opcode::ConstI32,
      Opcode::AddI32, Opcode::StoreI32This, Opcode::JumpIfFalse, Opcode::Return};
  EXPECT_EQ(code, expected);
}

TEST(Generate, Locals_WhenStatementsFollowEachOther_ThenTheyAreUsedAgain) {
  const auto locals = [](int count) {
    std::string body;
    for (int i = 0; i < count; ++i)
      body += "CASE x OF 1: FOR y := 1 TO x BY z DO b := b AND_THEN x > y; END_FOR; END_CASE; ";
    const support::CompiledProgram program(
        input_of("PROGRAM main VAR x, y, z : DINT; b : BOOL; END_VAR " + body + "END_PROGRAM"));
    const auto& container = program.loaded().program().container();
    return container.record<bytecode::Section::Functions>(0).local_count;
  };
  EXPECT_EQ(locals(1), 4u);
  EXPECT_EQ(locals(100), 4u);
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

TEST(Generate, HierarchicalAddresses_WhenThereAreFlatOnes_ThenTheyLieBehindInTheOrderOfTheirNumbers) {
  const support::CompiledProgram program(
      input_of("PROGRAM main VAR c AT %QW0.10 : INT; b AT %QD0.9 : DINT; a AT %QB0.2 : BYTE; flat AT %QB4 : "
               "BYTE; END_VAR "
               "%QB0.1 := 3; END_PROGRAM"));
  const auto outputs = program.loaded().program().sizes().input_bytes;
  EXPECT_EQ(program.find("main.flat").address - outputs, 4u);
  EXPECT_EQ(program.find("main.a").address - outputs, 6u);  // behind %QB0.1
  EXPECT_EQ(program.find("main.b").address - outputs, 8u);
  EXPECT_EQ(program.find("main.c").address - outputs, 12u);
  EXPECT_EQ(program.loaded().program().sizes().output_bytes, 14u);
}

// Whether every byte of a variable is in the retain map; nothing if only a part is.
std::optional<bool> is_retained(const support::CompiledProgram& program, const std::string& path) {
  const auto& container = program.loaded().program().container();
  const reader::Variable variable = program.find(path);
  const std::uint32_t size = bytecode::size_of(bytecode::mem_type(variable.type));
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < container.count<bytecode::Section::RetainMap>(); ++i) {
    const auto record = container.record<bytecode::Section::RetainMap>(i);
    for (std::uint32_t at = 0; at < size; ++at)
      if (variable.address + at >= record.address && variable.address + at < record.address + record.size)
        ++kept;
  }
  if (kept != 0 && kept != size) return std::nullopt;
  return kept == size;
}

TEST(Generate, Retain_WhenBlocksAreNested_ThenTheNearestWordCounts) {
  const support::CompiledProgram program(input_of(
      "FUNCTION_BLOCK inner VAR a : INT; END_VAR VAR RETAIN b : INT; END_VAR VAR NON_RETAIN c : INT; END_VAR "
      "END_FUNCTION_BLOCK\n"
      "FUNCTION_BLOCK outer VAR i : inner; END_VAR VAR NON_RETAIN j : inner; END_VAR VAR d : INT; END_VAR "
      "END_FUNCTION_BLOCK\n"
      "PROGRAM main VAR RETAIN k : outer; l : ARRAY[1..2] OF inner; END_VAR VAR m : outer; e : INT; END_VAR "
      "END_PROGRAM\n"
      "CONFIGURATION c TASK t(INTERVAL := T#1ms); PROGRAM p WITH t : main; PROGRAM RETAIN q WITH t : main; "
      "PROGRAM NON_RETAIN r WITH t : main; END_CONFIGURATION"));
  for (const char* kept : {"p.k.i.a", "p.k.i.b", "p.k.j.b", "p.k.d", "p.l[1].a", "p.l[2].b", "p.m.i.b", "q.e",
                           "q.m.d", "q.m.i.a", "r.k.d", "r.m.i.b"})
    EXPECT_EQ(is_retained(program, kept), true) << kept;
  for (const char* lost :
       {"p.k.i.c", "p.k.j.a", "p.l[1].c", "p.m.i.a", "p.m.d", "p.e", "q.m.i.c", "q.m.j.a", "r.e", "r.m.d"})
    EXPECT_EQ(is_retained(program, lost), false) << lost;
}

TEST(Generate, Tasks_WhenOneIsTriggered_ThenItsRecordNamesTheSymbol) {
  const support::CompiledProgram program(input_of(
      "PROGRAM main VAR_OUTPUT out : BOOL; END_VAR END_PROGRAM\n"
      "CONFIGURATION c VAR_GLOBAL go : BOOL; END_VAR TASK fast(INTERVAL := T#1ms); TASK a(SINGLE := go); "
      "TASK b(SINGLE := p.out); PROGRAM p WITH fast : main; PROGRAM q WITH a : main; PROGRAM r WITH b : "
      "main; "
      "END_CONFIGURATION"));
  const auto& container = program.loaded().program().container();
  const auto address = [&](std::uint32_t task) {
    const auto record = container.record<bytecode::Section::Tasks>(task);
    return container.record<bytecode::Section::Symbols>(record.trigger).address;
  };
  EXPECT_EQ(container.record<bytecode::Section::Tasks>(0).trigger, bytecode::kNoIndex);
  EXPECT_EQ(container.record<bytecode::Section::Tasks>(1).interval_us, 0u);
  EXPECT_EQ(address(1), program.find("go").address);
  EXPECT_EQ(address(2), program.find("p.out").address);
}

TEST(Generate, Instances_WhenTheyHaveNoConnections_ThenNothingRunsAroundTheProgram) {
  const std::string main =
      "PROGRAM main VAR_INPUT x : INT; END_VAR END_PROGRAM CONFIGURATION c VAR_GLOBAL g : INT; "
      "END_VAR TASK t(INTERVAL := T#1ms); PROGRAM p WITH t : main";
  const auto functions = [&](const std::string& connections) {
    const support::CompiledProgram program(input_of(main + connections + "; END_CONFIGURATION"));
    return program.loaded().program().container().count<bytecode::Section::Functions>();
  };
  EXPECT_EQ(functions(""), 1u);
  EXPECT_EQ(functions("(x := g)"), 2u);
}

}  // namespace

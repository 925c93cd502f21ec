// Two boolean instructions in one: what the builder makes of them, and that they mean the same.

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/bytecode/instruction.h"
#include "tests/support/test_program.h"

namespace stepwright::vm {
namespace {

using bytecode::AddressMode;
using bytecode::MemType;
using bytecode::Opcode;
using support::one_program;
using support::TestProgram;
using writer::FunctionBuilder;

std::vector<Opcode> opcodes_of(const writer::ContainerModel& model) {
  std::vector<Opcode> out;
  bytecode::Instruction in;
  const auto& code = model.functions[0].code;
  for (std::uint32_t pc = 0; pc < code.size(); pc += in.size) {
    if (!bytecode::decode(code, pc, in)) break;
    out.push_back(in.opcode);
  }
  return out;
}

// out := (NOT) a op1 (NOT) b op2 (NOT) c; inputs at 0 to 2, the output at 3.
struct Rung {
  bool negated[3] = {};
  bool ors[2] = {};

  void emit(FunctionBuilder& f, AddressMode mode) const {
    for (std::uint32_t i = 0; i < 3; ++i) {
      f.load(MemType::Bool, mode, i);
      if (negated[i]) f.emit(Opcode::NotBool);
      if (i > 0) f.emit(ors[i - 1] ? Opcode::OrBool : Opcode::AndBool);
    }
    f.store(MemType::Bool, mode, 3);
  }

  bool power(int inputs) const {
    bool value = false;
    for (int i = 0; i < 3; ++i) {
      const bool contact = ((inputs >> i) & 1) != (negated[i] ? 1 : 0);
      value = i == 0 ? contact : ors[i - 1] ? value || contact : value && contact;
    }
    return value;
  }
};

TEST(BooleanPair, RungsOfThreeContacts_WhenRun_ThenTakeTwoInstructionsAndAgreeWithLogic) {
  for (int shape = 0; shape < 32; ++shape) {
    const Rung rung{{(shape & 1) != 0, (shape & 2) != 0, (shape & 4) != 0},
                    {(shape & 8) != 0, (shape & 16) != 0}};
    for (const AddressMode mode : {AddressMode::Abs, AddressMode::This}) {
      const auto model = one_program(5, [&](FunctionBuilder& f) { rung.emit(f, mode); });
      EXPECT_EQ(opcodes_of(model).size(), 3u) << "shape " << shape;  // and Return
      for (int inputs = 0; inputs < 8; ++inputs) {
        TestProgram program(model);
        for (int i = 0; i < 3; ++i) {
          program.write<std::uint8_t>(static_cast<std::uint32_t>(i), ((inputs >> i) & 1) != 0 ? 0x40 : 0);
        }
        program.write<std::uint8_t>(3, 0x55);
        program.write<std::uint8_t>(4, 0x55);
        ASSERT_FALSE(program.run());
        EXPECT_EQ(program.read<std::uint8_t>(3), rung.power(inputs) ? 1 : 0) << "shape " << shape;
        EXPECT_EQ(program.read<std::uint8_t>(4), 0x55);
      }
    }
  }
}

TEST(BooleanPair, Moves_WhenRun_ThenCopyAndNegate) {
  for (const bool negated : {false, true}) {
    const auto model = one_program(2, [&](FunctionBuilder& f) {
      f.load(MemType::Bool, AddressMode::This, 0);
      if (negated) f.emit(Opcode::NotBool);
      f.store(MemType::Bool, AddressMode::This, 1);
    });
    EXPECT_EQ(opcodes_of(model)[0], negated ? Opcode::MoveNotBoolThis : Opcode::MoveBoolThis);
    for (const int input : {0, 2}) {
      TestProgram program(model);
      program.write(0, static_cast<std::uint8_t>(input));
      ASSERT_FALSE(program.run());
      EXPECT_EQ(program.read<std::uint8_t>(1), (input != 0) != negated ? 1 : 0);
    }
  }
}

TEST(BooleanPair, Values_WhenMoreLieOnTheStack_ThenAreKept) {
  TestProgram program(one_program(8, [](FunctionBuilder& f) {
    f.const_i32(77);
    f.load(MemType::Bool, AddressMode::This, 0);
    f.load(MemType::Bool, AddressMode::This, 1);
    f.emit(Opcode::OrBool);
    f.load(MemType::Bool, AddressMode::This, 1);
    f.emit(Opcode::AndBool);
    f.store(MemType::Bool, AddressMode::This, 2);
    f.store(MemType::I32, AddressMode::This, 4);
  }));
  program.write<std::uint8_t>(1, 1);
  ASSERT_FALSE(program.run());
  EXPECT_EQ(program.read<std::uint8_t>(2), 1);
  EXPECT_EQ(program.read<std::int32_t>(4), 77);
}

TEST(BooleanPair, Instructions_WhenModesDifferOrALabelOrLineComesBetween_ThenStayApart) {
  using Emit = std::function<void(FunctionBuilder&)>;
  const auto stored = [](AddressMode target, const Emit& between) {
    return opcodes_of(one_program(4, [&](FunctionBuilder& f) {
      f.load(MemType::Bool, AddressMode::This, 0);
      between(f);
      f.store(MemType::Bool, target, 1);
    }));
  };
  const Emit nothing = [](FunctionBuilder&) {};
  EXPECT_EQ(stored(AddressMode::This, nothing).size(), 2u);
  EXPECT_EQ(stored(AddressMode::Abs, nothing).size(), 3u);
  EXPECT_EQ(stored(AddressMode::This, [](FunctionBuilder& f) { f.bind(f.new_label()); }).size(), 3u);
  EXPECT_EQ(stored(AddressMode::This, [](FunctionBuilder& f) { f.line(0, 3); }).size(), 3u);
}

}  // namespace
}  // namespace stepwright::vm

#include "runtime/bytecode/code_check.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "runtime/bytecode/trap.h"
#include "tests/support/test_program.h"

namespace stepwright::bytecode {
namespace {

using writer::FunctionBuilder;

// What the writer says to a program with this body ("" = accepted); the writer passes the verifier's word on.
std::string refusal_of(const std::function<void(FunctionBuilder&)>& emit,
                       std::vector<writer::Function> more = {}) {
  const auto bytes = writer::write_container(support::one_program(16, emit, std::move(more)));
  return bytes ? std::string() : result::to_string(bytes.error());
}

void expect_refused(VerifyStatus status, const std::function<void(FunctionBuilder&)>& emit) {
  EXPECT_NE(refusal_of(emit).find(explain(status)), std::string::npos)
      << "expected: " << explain(status) << "\nbut: " << refusal_of(emit);
}

// A program whose code is given byte by byte: what no builder would emit.
std::string refusal_of_code(std::vector<std::uint8_t> code) {
  writer::ContainerModel model = support::one_program(16, [](FunctionBuilder&) {});
  model.functions[0].code.clear();
  for (const std::uint8_t byte : code) model.functions[0].code.push_back(static_cast<std::byte>(byte));
  const auto bytes = writer::write_container(model);
  return bytes ? std::string() : result::to_string(bytes.error());
}

std::uint8_t op(Opcode opcode) {
  return static_cast<std::uint8_t>(opcode);
}

TEST(CodeCheck, Stack_WhenTooLittleIsOnIt_ThenIsRefused) {
  expect_refused(VerifyStatus::StackUnderflow, [](auto& f) { f.emit(Opcode::AddI32); });
  expect_refused(VerifyStatus::StackUnderflow, [](auto& f) { f.emit(Opcode::Dup); });
  expect_refused(VerifyStatus::StackUnderflow, [](auto& f) { f.emit(Opcode::Drop); });
  expect_refused(VerifyStatus::StackUnderflow, [](auto& f) {
    f.const_i32(1);
    f.const_bool(true);
    f.emit(Opcode::Select);
  });
}

TEST(CodeCheck, Stack_WhenATypeIsWrong_ThenIsRefused) {
  expect_refused(VerifyStatus::StackType, [](auto& f) {
    f.const_i32(1);
    f.const_f32(1.0f);
    f.emit(Opcode::AddF32);
  });
  expect_refused(VerifyStatus::StackType, [](auto& f) {
    f.const_i32(1);
    f.store(MemType::Bool, AddressMode::Abs, 0);
  });
  expect_refused(VerifyStatus::StackType, [](auto& f) {
    const auto local = f.add_local(StackType::I64);
    f.const_i32(1);
    f.local_set(local);
  });
  expect_refused(VerifyStatus::StackType, [](auto& f) {
    f.const_i64(4);
    f.load(MemType::I32, AddressMode::Ind);
  });
}

TEST(CodeCheck, Return_WhenValuesAreLeft_ThenIsRefused) {
  expect_refused(VerifyStatus::StackJoin, [](auto& f) { f.const_i32(1); });
}

TEST(CodeCheck, Join_WhenStacksDiffer_ThenIsRefused) {
  expect_refused(VerifyStatus::StackJoin, [](auto& f) {
    const auto join = f.new_label();
    f.const_bool(true);
    f.jump_if_true(join);
    f.const_i32(1);
    f.bind(join);
  });
  expect_refused(VerifyStatus::StackJoin, [](auto& f) {
    const auto other = f.new_label();
    const auto join = f.new_label();
    f.const_bool(true);
    f.jump_if_true(other);
    f.const_i32(1);
    f.jump(join);
    f.bind(other);
    f.const_f32(1);
    f.bind(join);
    f.emit(Opcode::Drop);
  });
}

TEST(CodeCheck, Loop_WhenItGrowsTheStack_ThenIsRefused) {
  expect_refused(VerifyStatus::StackJoin, [](auto& f) {
    const auto head = f.new_label();
    f.bind(head);
    f.const_i32(1);
    f.const_bool(true);
    f.jump_if_true(head);
    f.emit(Opcode::Drop);
  });
}

TEST(CodeCheck, Join_WhenValuesStayOnTheStackAcrossBranches_ThenIsAccepted) {
  EXPECT_EQ(refusal_of([](auto& f) {
              const auto other = f.new_label();
              const auto join = f.new_label();
              f.const_i32(7);
              f.const_bool(true);
              f.jump_if_true(other);
              f.const_f64(1);
              f.jump(join);
              f.bind(other);
              f.const_f64(2);
              f.bind(join);
              f.store(MemType::F64, AddressMode::Abs, 0);
              f.store(MemType::I32, AddressMode::Abs, 8);
            }),
            "");
}

TEST(CodeCheck, Memory_WhenAnAccessLeavesImageOrInstance_ThenIsRefused) {
  EXPECT_EQ(refusal_of([](auto& f) {
              f.load(MemType::I64, AddressMode::Abs, 8);
              f.store(MemType::I64, AddressMode::This, 0);
            }),
            "");
  expect_refused(VerifyStatus::BadAddress, [](auto& f) { f.load(MemType::I64, AddressMode::Abs, 9); });
  expect_refused(VerifyStatus::BadAddress, [](auto& f) { f.load(MemType::Bool, AddressMode::This, 16); });
  expect_refused(VerifyStatus::BadAddress,
                 [](auto& f) { f.load(MemType::I16, AddressMode::Abs, 0xFFFFFFFF); });
  expect_refused(VerifyStatus::BadAddress, [](auto& f) { f.load_bit(16, 0); });
  expect_refused(VerifyStatus::BadAddress, [](auto& f) { f.load_bit(0, 8); });
  expect_refused(VerifyStatus::BadAddress, [](auto& f) { f.addr_abs(16); });
}

TEST(CodeCheck, Operand_WhenOutOfRange_ThenIsRefused) {
  expect_refused(VerifyStatus::BadOperand, [](auto& f) { f.local_get(writer::LocalId(0)); });
  expect_refused(VerifyStatus::BadOperand, [](auto& f) {
    f.addr_abs(0);
    f.const_i32(0);
    f.index(3, 2, 1);
  });
  expect_refused(VerifyStatus::BadOperand, [](auto& f) { f.trap(kTrapCodeCount); });
  expect_refused(VerifyStatus::BadOperand, [](auto& f) {
    f.const_i32(1);
    f.const_i32(1);
    f.rotate_i32(Opcode::RolI32, 7);
  });
  EXPECT_NE(refusal_of_code({op(Opcode::ConstI64), 0, 0, 0, 0, op(Opcode::Drop), op(Opcode::Return)}), "");
  EXPECT_NE(refusal_of_code({op(Opcode::ConstBool), 2, op(Opcode::Drop), op(Opcode::Return)}), "");
}

TEST(CodeCheck, Code_WhenCutOrUnknown_ThenIsRefused) {
  const auto says = [](const std::string& text, VerifyStatus status) {
    return text.find(explain(status)) != std::string::npos;
  };
  EXPECT_TRUE(says(refusal_of_code({}), VerifyStatus::MissingReturn));
  EXPECT_TRUE(
      says(refusal_of_code({op(Opcode::ConstBool), 1, op(Opcode::Drop)}), VerifyStatus::MissingReturn));
  EXPECT_TRUE(says(refusal_of_code({op(Opcode::ConstI32), 1, 2}), VerifyStatus::BadOperand));
  EXPECT_TRUE(says(refusal_of_code({kOpcodeCount}), VerifyStatus::BadOpcode));
}

TEST(CodeCheck, Jump_WhenItMissesAnInstruction_ThenIsRefused) {
  const auto says_bad_jump = [](const std::string& text) {
    return text.find(explain(VerifyStatus::BadJump)) != std::string::npos;
  };
  const std::uint8_t jump = op(Opcode::Jump);
  const std::uint8_t ret = op(Opcode::Return);
  // Into the middle of the next instruction, before the function, behind it, onto its end, into itself.
  EXPECT_TRUE(says_bad_jump(refusal_of_code({op(Opcode::ConstBool), 1, op(Opcode::JumpIfTrue), 2, 0, 0, 0,
                                             op(Opcode::ConstI32), 0, 0, 0, 0, op(Opcode::Drop), ret})));
  EXPECT_TRUE(says_bad_jump(refusal_of_code({jump, 0xF0, 0xFF, 0xFF, 0xFF, ret})));
  EXPECT_TRUE(says_bad_jump(refusal_of_code({jump, 9, 0, 0, 0, ret})));
  EXPECT_TRUE(says_bad_jump(refusal_of_code({jump, 1, 0, 0, 0, ret})));
  EXPECT_TRUE(says_bad_jump(refusal_of_code({jump, 0xFE, 0xFF, 0xFF, 0xFF, ret})));
  EXPECT_EQ(refusal_of_code({jump, 0, 0, 0, 0, ret}), "");
}

TEST(CodeCheck, Call_WhenTargetIsMissingOrOfAnotherKind_ThenIsRefused) {
  expect_refused(VerifyStatus::BadCall, [](auto& f) { f.call(1); });
  expect_refused(VerifyStatus::BadCall, [](auto& f) { f.call(0); });
  expect_refused(VerifyStatus::BadCall, [](auto& f) { f.call_instance(AddressMode::Abs, 7, 0); });
}

writer::Function calling(const std::string& name, std::uint32_t callee) {
  FunctionBuilder f(name, FunctionKind::Function);
  f.call(callee);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

TEST(CodeCheck, Calls_WhenTheyRecurse_ThenAreRefused) {
  const std::string direct = refusal_of([](auto& f) { f.call(1); }, {calling("A", 1)});
  EXPECT_NE(direct.find(explain(VerifyStatus::Recursion)), std::string::npos) << direct;
  const std::string mutual = refusal_of([](auto& f) { f.call(1); }, {calling("A", 2), calling("B", 1)});
  EXPECT_NE(mutual.find(explain(VerifyStatus::Recursion)), std::string::npos) << mutual;
}

TEST(CodeCheck, Calls_WhenTheyNest_ThenDepthAndStackAreSummedUp) {
  FunctionBuilder leaf("LEAF", FunctionKind::Function);
  leaf.add_param(StackType::I32);
  leaf.set_result(StackType::I32);
  leaf.const_i32(2);
  leaf.emit(Opcode::Return);
  FunctionBuilder middle("MIDDLE", FunctionKind::Function);
  middle.set_result(StackType::I32);
  middle.const_i32(1);
  middle.call(2);
  middle.emit(Opcode::Return);
  std::vector<writer::Function> more;
  more.push_back(std::move(middle).take());
  more.push_back(std::move(leaf).take());
  const support::TestProgram program(support::one_program(
      16,
      [](auto& f) {
        f.const_i32(1);
        f.call(1);
        f.emit(Opcode::AddI32);
        f.store(MemType::I32, AddressMode::This, 0);
      },
      std::move(more)));
  const SizesRecord sizes = program.loaded().program().sizes();
  EXPECT_EQ(sizes.call_depth, 3u);
  // MAIN: 2 operands; MIDDLE: 1; LEAF: 1 local and 1 operand; 3 slots of the engine each.
  EXPECT_EQ(sizes.stack_slots, (2u + 3) + (1u + 3) + (1u + 1 + 3));
}

TEST(CodeCheck, CallInstance_WhenTheInstanceDoesNotFit_ThenIsRefused) {
  const auto block = [] {
    FunctionBuilder f("FB", FunctionKind::FunctionBlock, 8);
    f.emit(Opcode::Return);
    return std::move(f).take();
  };
  EXPECT_EQ(refusal_of([](auto& f) { f.call_instance(AddressMode::This, 1, 8); }, {block()}), "");
  EXPECT_NE(refusal_of([](auto& f) { f.call_instance(AddressMode::This, 1, 9); }, {block()}), "");
  EXPECT_NE(refusal_of([](auto& f) { f.call_instance(AddressMode::Abs, 1, 9); }, {block()}), "");
}

TEST(CodeCheck, Refusal_WhenTheCodeHasLines_ThenNamesFunctionAndLine) {
  writer::ContainerModel model = support::one_program(16, [](auto& f) {
    f.line(0, 3);
    f.const_i32(1);
    f.line(0, 4);
    f.emit(Opcode::NotBool);
  });
  model.source_files = {"main.st"};
  const auto bytes = writer::write_container(model);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error()[0].where.file, "main.st");
  EXPECT_EQ(bytes.error()[0].where.line, 4u);
  EXPECT_NE(bytes.error()[0].message.find("MAIN"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::bytecode

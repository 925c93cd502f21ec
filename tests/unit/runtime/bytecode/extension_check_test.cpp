// The verifier's rules for frames, types, triggers, subranges, strings and fused booleans: each with a
// container that breaks it.

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "runtime/bytecode/member_bit.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "tests/support/test_program.h"
#include "tests/unit/runtime/bytecode/container_change.h"

namespace stepwright::bytecode {
namespace {

using writer::FunctionBuilder;

constexpr std::uint32_t kBool = 0, kDint = 1, kText = 2, kColour = 3, kPointer = 4, kNode = 5, kSmall = 6,
                        kBig = 7, kRow = 8;

writer::Function helper() {
  FunctionBuilder f("HELPER", FunctionKind::Function);
  f.addr_frame(f.allocate_frame(12, 4));
  f.const_i32(1);
  f.store(MemType::I32, AddressMode::Ind);
  f.emit(Opcode::Return);
  return std::move(f).take();
}

// Instance of 64 bytes: BOOLs at 0 and 1, a DINT at 4, a STRING[20] at 8.
writer::ContainerModel model() {
  writer::ContainerModel out = support::one_program(64,
                                                    [](FunctionBuilder& f) {
                                                      static_cast<void>(f.allocate_frame(8, 8));
                                                      f.load(MemType::Bool, AddressMode::This, 0);
                                                      f.load(MemType::Bool, AddressMode::This, 1);
                                                      f.emit(Opcode::AndBool);
                                                      f.store(MemType::Bool, AddressMode::This, 0);
                                                      f.load(MemType::I32, AddressMode::This, 4);
                                                      f.check_i32(-5, 5);
                                                      f.store(MemType::I32, AddressMode::This, 4);
                                                      f.addr_this(8);
                                                      f.string_op(StringOpId::ClearS);
                                                      f.call(1);
                                                    },
                                                    {helper()});
  out.types = {
      writer::elementary(ElementaryType::Bool),
      writer::elementary(ElementaryType::Dint),
      writer::string_type(ElementaryType::String, 20),
      {.name = "COLOUR",
       .kind = TypeKind::Enumeration,
       .elementary = ElementaryType::Int,
       .size = 2,
       .members = {{"RED", 0, 0}, {"GREEN", 0, 0xFFFFFFFF}}},
      {.name = "REF_TO NODE", .kind = TypeKind::Reference, .size = 4, .element = kNode, .members = {}},
      {.name = "NODE", .kind = TypeKind::Struct, .size = 4, .members = {{"next", kPointer, 0}}},
      {.name = "SMALL",
       .kind = TypeKind::Subrange,
       .elementary = ElementaryType::Int,
       .size = 2,
       .lower = -5,
       .upper = 5,
       .members = {}},
      {.name = "BIG",
       .kind = TypeKind::Subrange,
       .elementary = ElementaryType::Ulint,
       .size = 8,
       .lower = 5,
       .upper = -1,
       .members = {}},
      {.name = "ROW",
       .kind = TypeKind::Array,
       .size = 12,
       .element = kDint,
       .count = 3,
       .lower = -1,
       .members = {}}};
  out.symbols = {{.name = "go", .type = kBool, .address = 0, .direct_address = {}},
                 {.name = "text", .type = kText, .address = 8, .direct_address = {}},
                 {.name = "n", .type = kDint, .address = 4, .direct_address = {}}};
  out.tasks.push_back({.name = "event", .interval_us = 0, .priority = 0, .calls = {}, .trigger = 0});
  return out;
}

std::vector<std::byte> bytes() {
  return writer::write_container(model()).value();
}

template <Section S>
VerifyStatus changed(std::uint32_t index, const std::function<void(Record<S>&)>& change) {
  return verify_changed<S>(bytes(), index, change).status;
}

using S = Section;
using V = VerifyStatus;

TEST(ExtensionCheck, Model_WhenUntouched_ThenIsAccepted) {
  EXPECT_EQ(verify_bytes(bytes()).status, V::Ok);
}

TEST(ExtensionCheck, Frames_WhenTheyDoNotFit_ThenAreRefused) {
  EXPECT_EQ(changed<S::Functions>(1, [](auto& r) { r.frame_offset += 1; }), V::BadFrame);
  EXPECT_EQ(changed<S::Functions>(1, [](auto& r) { r.frame_size += 1; }), V::BadFrame);
  EXPECT_EQ(changed<S::Functions>(1, [](auto& r) { r.frame_offset = 0xFFFFFFF8; }), V::BadFrame);
  EXPECT_EQ(changed<S::Functions>(1, [](auto& r) { r.frame_offset -= 1; }), V::BadFrame)
      << "overlaps its caller";
  EXPECT_EQ(changed<S::Functions>(0, [](auto& r) { r.frame_size += 1; }), V::BadFrame)
      << "overlaps its callee";
  EXPECT_EQ(changed<S::Functions>(1, [](auto& r) { r.frame_size = 0; }), V::BadAddress)
      << "AddrFrame outside";
  EXPECT_EQ(changed<S::Sizes>(0, [](auto& r) { r.frame_bytes = 32u << 20; }), V::TooLarge) << "of two tasks";
}

TEST(ExtensionCheck, InstanceCall_WhenTheFrameOverlaps_ThenIsRefused) {
  FunctionBuilder block("FB", FunctionKind::FunctionBlock, 4);
  static_cast<void>(block.allocate_frame(8, 8));
  block.emit(Opcode::Return);
  const auto caller = [](FunctionBuilder& f) {
    static_cast<void>(f.allocate_frame(8, 8));
    f.call_instance(AddressMode::This, 1, 0);
  };
  const auto good =
      writer::write_container(support::one_program(8, caller, {std::move(block).take()})).value();
  EXPECT_EQ(verify_changed<S::Functions>(good, 1, [](auto& r) { r.frame_offset = 7; }).status, V::BadFrame);
}

TEST(ExtensionCheck, Members_WhenOneIsABit_ThenItIsABool) {
  constexpr std::uint32_t kEnumerator = 0, kNext = 2;
  const auto member = [](std::uint32_t index, std::uint32_t type, std::uint32_t flags) {
    return changed<S::Members>(index, [&](auto& r) { r.type = type, r.flags = flags; });
  };
  EXPECT_EQ(member(kNext, kBool, bit_member(0)), V::Ok);
  EXPECT_EQ(member(kNext, kBool, bit_member(7)), V::Ok);
  EXPECT_EQ(member(kNext, kPointer, bit_member(0)), V::BadType);
  EXPECT_EQ(member(kNext, kBool, bit_member(7) << 1), V::BadRecord);
  EXPECT_EQ(member(kNext, kBool, 1u << kMemberBitShift), V::BadRecord) << "a number without the flag";
  EXPECT_EQ(member(kEnumerator, kNoIndex, bit_member(0)), V::BadRecord);
}

TEST(ExtensionCheck, Types_WhenAKindsRuleIsBroken_ThenAreRefused) {
  const auto type = [](std::uint32_t index, const std::function<void(TypeRecord&)>& change) {
    return changed<S::Types>(index, change);
  };
  EXPECT_EQ(type(kBool, [](auto& r) { r.elementary = 21; }), V::BadType) << "a string is no scalar";
  EXPECT_EQ(type(kBool, [](auto& r) { r.elementary = 23; }), V::BadType);
  EXPECT_EQ(type(kBool, [](auto& r) { r.upper = 1; }), V::BadType);
  EXPECT_EQ(type(kText, [](auto& r) { r.count = 21; }), V::BadType);
  EXPECT_EQ(type(kText, [](auto& r) { r.elementary = 22; }), V::BadType);
  EXPECT_EQ(type(kText, [](auto& r) { r.elementary = 2; }), V::BadType);
  EXPECT_EQ(type(kText, [](auto& r) { r.count = 65536, r.size = 65540; }), V::BadType);
  EXPECT_EQ(type(kColour, [](auto& r) { r.elementary = 13; }), V::BadType) << "REAL has no enumerators";
  EXPECT_EQ(type(kColour, [](auto& r) { r.size = 4; }), V::BadType);
  EXPECT_EQ(type(kColour, [](auto& r) { r.count = 1; }), V::BadType) << "a gap in the members";
  EXPECT_EQ(changed<S::Members>(0, [](auto& r) { r.type = kBool; }), V::BadType);
  EXPECT_EQ(changed<S::Members>(0, [](auto& r) { r.flags = kMemberConstant; }), V::BadRecord);
  EXPECT_EQ(type(kPointer, [](auto& r) { r.first = 9; }), V::BadType);
  EXPECT_EQ(type(kPointer, [](auto& r) { r.size = 8; }), V::BadType);
  EXPECT_EQ(type(kSmall, [](auto& r) { r.lower = 6; }), V::BadType);
  EXPECT_EQ(type(kSmall, [](auto& r) { r.elementary = 0; }), V::BadType);
  EXPECT_EQ(type(kBig, [](auto& r) { r.upper = 4; }), V::BadType);
  EXPECT_EQ(type(kRow, [](auto& r) { r.upper = 2; }), V::BadType);
  EXPECT_EQ(type(kRow, [](auto& r) { r.lower = std::int64_t{1} << 40, r.upper = r.lower + 2; }), V::BadType);
}

TEST(ExtensionCheck, Triggers_WhenTheyAreNoBool_ThenAreRefused) {
  EXPECT_EQ(changed<S::Tasks>(1, [](auto& r) { r.trigger = 2; }), V::BadRecord);
  EXPECT_EQ(changed<S::Tasks>(1, [](auto& r) { r.trigger = 3; }), V::BadRecord);
  EXPECT_EQ(changed<S::Tasks>(1, [](auto& r) { r.trigger = kNoIndex; }), V::Ok) << "it is freewheeling";
  EXPECT_EQ(changed<S::Tasks>(0, [](auto& r) { r.interval_us = 0, r.trigger = 0; }), V::BadRecord)
      << "nothing would look at the triggers";
}

// A program whose body is changed at the first place where `from` stands.
VerifyStatus with_body(const std::function<void(FunctionBuilder&)>& emit, std::size_t at,
                       std::uint32_t operand, std::size_t size = 4) {
  auto file = writer::write_container(support::one_program(16, emit)).value();
  std::memcpy(file.data() + entry_of(file, Section::Code).offset + at, &operand, size);
  fix_checksum(file);
  return verify_bytes(file).status;
}

TEST(ExtensionCheck, Operands_WhenOutOfRange_ThenAreRefused) {
  const auto fused = [](FunctionBuilder& f) {
    f.const_bool(true);
    f.load(MemType::Bool, AddressMode::This, 15);
    f.emit(Opcode::OrBool);
    f.load(MemType::Bool, AddressMode::Abs, 15);
    f.emit(Opcode::AndBool);
    f.store(MemType::Bool, AddressMode::This, 0);
  };
  EXPECT_EQ(with_body(fused, 3, 15), V::Ok);
  EXPECT_EQ(with_body(fused, 3, 16), V::BadAddress);
  EXPECT_EQ(with_body(fused, 8, 16), V::BadAddress);
  const auto check32 = [](FunctionBuilder& f) {
    f.const_i32(1);
    f.check_i32(1, 5);
    f.emit(Opcode::Drop);
  };
  EXPECT_EQ(with_body(check32, 6, 5), V::Ok);
  EXPECT_EQ(with_body(check32, 6, 6), V::BadOperand);
  for (const bool is_unsigned : {false, true}) {
    const auto check64 = [&](FunctionBuilder& f) {
      f.const_i64(-1);  // constant 0; as unsigned the largest
      is_unsigned ? f.check_u64(1, ~0ull) : f.check_i64(-1, 1);
      f.emit(Opcode::Drop);
    };
    EXPECT_EQ(with_body(check64, 6, is_unsigned ? 1 : 0), V::Ok);
    EXPECT_EQ(with_body(check64, 6, 2), V::BadOperand);
    EXPECT_EQ(with_body(check64, 10, 2), V::BadOperand);
  }
  // The constants -1 and 1, in order as signed numbers and not as unsigned ones.
  const auto signed_check = [](FunctionBuilder& f) {
    f.const_i64(0);
    f.check_i64(-1, 1);
    f.emit(Opcode::Drop);
  };
  EXPECT_EQ(with_body(signed_check, 5, static_cast<std::uint32_t>(Opcode::CheckU64), 1), V::BadOperand);
  const auto string = [](FunctionBuilder& f) {
    f.addr_this(0);
    f.string_op(StringOpId::ClearS);
  };
  EXPECT_EQ(with_body(string, 6, kStringOpCount, 1), V::BadOperand);
  EXPECT_EQ(with_body(string, 6, static_cast<std::uint32_t>(StringOpId::CopyS), 1), V::StackUnderflow);
  EXPECT_EQ(with_body(string, 6, static_cast<std::uint32_t>(StringOpId::LengthS), 1), V::StackJoin);
  EXPECT_EQ(with_body(string, 0, static_cast<std::uint32_t>(Opcode::ConstI32), 1), V::StackType);
  const auto dynamic = [](FunctionBuilder& f) {
    f.addr_this(0);
    for (int i = 0; i < 3; ++i) f.const_i32(0);
    f.index_dyn(16);
    f.emit(Opcode::Drop);
  };
  EXPECT_EQ(with_body(dynamic, 21, 16), V::Ok);
  EXPECT_EQ(with_body(dynamic, 21, 17), V::BadAddress);
  const auto intrinsic = [](FunctionBuilder& f) {
    f.const_f64(1);
    f.intrinsic(IntrinsicId::SinF64);
    f.emit(Opcode::Drop);
  };
  EXPECT_EQ(with_body(intrinsic, 6, kIntrinsicCount, 1), V::BadOperand);
}

// Two callers of different depth: the callee lies behind the deeper one, and two leaves share their bytes.
TEST(ContainerWriter, Frames_WhenCallsNest_ThenFollowTheLongestWay) {
  const auto function = [](const char* name, std::uint32_t bytes, std::vector<std::uint32_t> calls) {
    FunctionBuilder f(name, FunctionKind::Function);
    static_cast<void>(f.allocate_frame(bytes, 1));
    for (const std::uint32_t callee : calls) f.call(callee);
    f.emit(Opcode::Return);
    return std::move(f).take();
  };
  const auto file =
      writer::write_container(support::one_program(8,
                                                   [](FunctionBuilder& f) {
                                                     f.call(1);
                                                     f.call(2);
                                                   },
                                                   {function("A", 20, {2, 3}), function("B", 3, {4}),
                                                    function("C", 100, {}), function("D", 8, {})}))
          .value();
  std::vector<std::uint32_t> scratch(verify_scratch_words(file));
  Program program;
  ASSERT_TRUE(verify(file, scratch, program).ok());
  const auto offset = [&](std::uint32_t f) {
    return program.container().record<Section::Functions>(f).frame_offset;
  };
  EXPECT_EQ(offset(1), 0u);
  EXPECT_EQ(offset(2), 24u);
  EXPECT_EQ(offset(3), 24u);
  EXPECT_EQ(offset(4), 32u);
  EXPECT_EQ(program.sizes().frame_bytes, 24u + 104u);
}

}  // namespace
}  // namespace stepwright::bytecode

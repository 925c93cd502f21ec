#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "runtime/bytecode/program.h"
#include "runtime/bytecode/writer/container_writer.h"
#include "tests/support/sample_model.h"
#include "tests/support/test_program.h"
#include "tests/unit/runtime/bytecode/container_change.h"

namespace stepwright::bytecode {
namespace {

std::vector<std::byte> sample_bytes() {
  return writer::write_container(support::sample_model()).value();
}

// The sample with one record changed.
template <Section S>
VerifyResult with_record(std::uint32_t index, const std::function<void(Record<S>&)>& change) {
  return verify_changed<S>(sample_bytes(), index, change);
}

TEST(Verify, Sample_WhenUntouched_ThenIsAccepted) {
  EXPECT_EQ(verify_bytes(sample_bytes()).status, VerifyStatus::Ok);
}

TEST(Verify, Sample_WhenAnySingleBitIsFlipped_ThenIsRefused) {
  std::vector<std::byte> bytes = sample_bytes();
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    ASSERT_FALSE(verify_bytes(bytes).ok()) << "bit " << bit;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

TEST(Verify, Sample_WhenCutAnywhere_ThenIsRefusedAsTruncated) {
  const std::vector<std::byte> bytes = sample_bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const VerifyResult result = verify_bytes(std::span(bytes).first(size));
    ASSERT_EQ(result.status, size < 4 ? VerifyStatus::NotAContainer : VerifyStatus::Truncated)
        << size << " bytes";
  }
}

TEST(Verify, Sample_WhenBytesFollow_ThenIsRefused) {
  std::vector<std::byte> bytes = sample_bytes();
  bytes.push_back(std::byte{0});
  EXPECT_EQ(verify_bytes(bytes).status, VerifyStatus::TrailingBytes);
}

TEST(Verify, Sample_WhenVersionIsNewer_ThenSaysSo) {
  std::vector<std::byte> bytes = sample_bytes();
  bytes[4] = std::byte{kVersion + 1};
  fix_checksum(bytes);
  EXPECT_EQ(verify_bytes(bytes).status, VerifyStatus::WrongVersion);
}

TEST(Verify, Sample_WhenScratchIsTooSmall_ThenSaysSo) {
  const std::vector<std::byte> bytes = sample_bytes();
  std::vector<std::uint32_t> scratch(verify_scratch_words(bytes) - 1);
  Program program;
  EXPECT_EQ(verify(bytes, scratch, program).status, VerifyStatus::ScratchTooSmall);
}

// Bits of a record that no checksum can vouch for: each change must be found by the rule it breaks.
TEST(Verify, Records_WhenOneIsInconsistent_ThenItIsNamed) {
  const auto expect = [](const VerifyResult& result, VerifyStatus status, Section section) {
    EXPECT_EQ(result.status, status) << explain(result.status);
    EXPECT_EQ(result.section, section);
  };
  using S = Section;
  using V = VerifyStatus;
  expect(with_record<S::Sizes>(0, [](auto& r) { r.data_bytes = 0xFFFFFFF0; }), V::TooLarge, S::Sizes);
  expect(with_record<S::Sizes>(0, [](auto& r) { r.stack_slots -= 1; }), V::WrongSizes, S::Sizes);
  expect(with_record<S::Sizes>(0, [](auto& r) { r.data_bytes -= 1; }), V::BadAddress, S::Symbols);
  expect(with_record<S::Types>(0, [](auto& r) { r.kind = 9; }), V::BadType, S::Types);
  expect(with_record<S::Types>(5, [](auto& r) { r.first = 5; }), V::BadType, S::Types);
  expect(with_record<S::Types>(5, [](auto& r) { r.count = 9; }), V::BadType, S::Types);
  expect(with_record<S::Members>(0, [](auto& r) { r.name.offset = 1u << 30; }), V::BadString, S::Members);
  expect(with_record<S::Members>(0, [](auto& r) { r.flags = 8; }), V::BadRecord, S::Members);
  expect(with_record<S::Members>(0, [](auto& r) { r.offset = 18; }), V::BadType, S::Types);
  expect(with_record<S::Symbols>(0, [](auto& r) { r.type = 99; }), V::BadType, S::Symbols);
  expect(with_record<S::Symbols>(0, [](auto& r) { r.bit = 8; }), V::BadRecord, S::Symbols);
  expect(with_record<S::Symbols>(1, [](auto& r) { r.bit = 1; }), V::BadRecord, S::Symbols);
  expect(with_record<S::Symbols>(4, [](auto& r) { r.address += 1; }), V::BadAddress, S::Symbols);
  expect(with_record<S::Tasks>(0, [](auto& r) { r.trigger = 99; }), V::BadRecord, S::Tasks);
  expect(with_record<S::Tasks>(1, [](auto& r) { r.call_count = 2; }), V::BadRecord, S::Tasks);
  expect(with_record<S::ProgramCalls>(0, [](auto& r) { r.function = 1; }), V::BadRecord, S::ProgramCalls);
  expect(with_record<S::ProgramCalls>(0, [](auto& r) { r.instance += 1; }), V::BadAddress, S::ProgramCalls);
  expect(with_record<S::Functions>(2, [](auto& r) { r.result = 6; }), V::BadRecord, S::Functions);
  expect(with_record<S::Functions>(0, [](auto& r) { r.max_stack += 1; }), V::WrongSizes, S::Functions);
  expect(with_record<S::Functions>(3, [](auto& r) { r.code_size += 1; }), V::BadRecord, S::Functions);
  expect(with_record<S::Functions>(0, [](auto& r) { r.flags = 2; }), V::BadRecord, S::Functions);
  expect(with_record<S::Locals>(0, [](auto& r) { r = 6; }), V::BadRecord, S::Locals);
  expect(with_record<S::IoMap>(0, [](auto& r) { r.symbol = 3; }), V::BadRecord, S::IoMap);
  expect(with_record<S::RetainMap>(0, [](auto& r) { r.size += 1; }), V::BadAddress, S::RetainMap);
  expect(with_record<S::SfcCharts>(0, [](auto& r) { r.step_count = 3; }), V::BadRecord, S::SfcCharts);
  expect(with_record<S::SfcSteps>(1, [](auto& r) { r.address = 4000; }), V::BadAddress, S::SfcSteps);
  expect(with_record<S::SfcTransitions>(1, [](auto& r) { r.bit = 0; }), V::BadRecord, S::SfcTransitions);
  expect(with_record<S::SfcLinks>(0, [](auto& r) { r = 2; }), V::BadRecord, S::SfcCharts);
  expect(with_record<S::SourceMap>(1, [](auto& r) { r.pc = 0; }), V::BadRecord, S::SourceMap);
  expect(with_record<S::SourceMap>(0, [](auto& r) { r.line = 0; }), V::BadRecord, S::SourceMap);
  expect(with_record<S::Strings>(0, [](auto& r) { r = 0xFF; }), V::BadString, S::Types);
}

TEST(Verify, Texts_WhenTheyAreLong_ThenConditionsAndCommentsMayBe) {
  const auto with_lengths = [](std::size_t name, std::size_t comment, std::size_t condition) {
    writer::ContainerModel model = support::sample_model();
    writer::SfcChart& chart = model.charts.front();
    chart.steps.front().name = std::string(name, 'n');
    chart.steps.front().comment = std::string(comment, 'c');
    chart.transitions.front().condition = std::string(condition, 't');
    const auto written = writer::try_write_container(model);
    return written ? VerifyStatus::Ok : written.error().verdict.status;
  };
  EXPECT_EQ(with_lengths(kMaxStringBytes, kMaxTextBytes, kMaxTextBytes), VerifyStatus::Ok);
  EXPECT_EQ(with_lengths(kMaxStringBytes + 1, 0, 0), VerifyStatus::BadString);
  EXPECT_EQ(with_lengths(1, kMaxTextBytes + 1, 0), VerifyStatus::BadString);
  EXPECT_EQ(with_lengths(1, 0, kMaxTextBytes + 1), VerifyStatus::BadString);
}

// However often one is used: a small file must not make viewers copy without end.
TEST(Verify, Texts_WhenTheLongOnesTogetherAreTooLong_ThenIsRefused) {
  const auto with_transitions = [](std::size_t count, std::uint32_t length) {
    writer::ContainerModel model = support::sample_model();
    writer::SfcChart& chart = model.charts.front();
    chart.transitions.front().condition = std::string(length, 't');
    chart.transitions.assign(count, writer::SfcTransition(chart.transitions.front()));
    const auto written = writer::try_write_container(model);
    return written ? VerifyStatus::Ok : written.error().verdict.status;
  };
  constexpr std::size_t kMost = kMaxLongTextBytes / kMaxTextBytes;
  EXPECT_EQ(with_transitions(kMost, kMaxTextBytes), VerifyStatus::Ok);
  EXPECT_EQ(with_transitions(kMost + 1, kMaxTextBytes), VerifyStatus::BadString);
  EXPECT_EQ(with_transitions(10 * kMost, kMaxStringBytes), VerifyStatus::Ok);
}

TEST(Verify, Locals_WhenThereAreTooMany_ThenIsRefused) {
  const auto with_locals = [](std::uint32_t count) {
    writer::ContainerModel model = support::sample_model();
    writer::FunctionBuilder f("many", FunctionKind::Function);
    for (std::uint32_t i = 0; i < count; ++i) f.add_local(StackType::I32);
    f.emit(Opcode::Return);
    model.functions.push_back(std::move(f).take());
    const auto written = writer::try_write_container(model);
    return written ? VerifyStatus::Ok : written.error().verdict.status;
  };
  EXPECT_EQ(with_locals(kMaxLocals), VerifyStatus::Ok);
  EXPECT_EQ(with_locals(kMaxLocals + 1), VerifyStatus::BadRecord);
}

// An engine that makes code sets slots aside for functions that nothing calls, too.
TEST(Verify, Functions_WhenThoseThatNothingCallsNeedTooManySlots_ThenIsRefused) {
  writer::ContainerModel model = support::sample_model();
  const auto deep = [](const char* name) {
    writer::FunctionBuilder f(name, FunctionKind::Function);
    f.const_i32(0);
    for (int i = 0; i < 600'000; ++i) f.emit(Opcode::Dup);
    for (int i = 0; i < 600'000; ++i) f.emit(Opcode::Drop);
    return f;
  };
  writer::FunctionBuilder inner = deep("inner");
  inner.emit(Opcode::Drop);
  inner.emit(Opcode::Return);
  model.functions.push_back(std::move(inner).take());
  EXPECT_TRUE(writer::write_container(model)) << "one of them fits";
  writer::FunctionBuilder outer = deep("outer");
  outer.emit(Opcode::Drop);
  outer.call(static_cast<std::uint32_t>(model.functions.size() - 1));
  outer.emit(Opcode::Return);
  model.functions.push_back(std::move(outer).take());
  const auto refused = writer::write_container(model);
  ASSERT_FALSE(refused);
  EXPECT_NE(result::to_string(refused.error()).find(explain(VerifyStatus::TooLarge)), std::string::npos)
      << result::to_string(refused.error());
}

// Damage behind a correct checksum must never crash the verifier or, where it is accepted, the engine.
}  // namespace
}  // namespace stepwright::bytecode

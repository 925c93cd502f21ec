#include "ladder/codegen/container_limits.h"

#include <gtest/gtest.h>

#include "runtime/bytecode/utf8.h"
#include "tests/support/compiled_program.h"

namespace {

using namespace stepwright;
using bytecode::Section;
using codegen::ContainerLimits;

// A program of two functions in a file, and a refusal of its container.
class Refused : public testing::Test {
 protected:
  Refused() : limits_(sources_) {
    const source::FileId file = sources_.add("plc.st", "first\n\nsecond\n");
    first_.spelling = "first";
    first_.where = {file, 0};
    second_.spelling = "second";
    second_.where = {file, 7};
    for (const auto* each : functions_)
      model_.functions.push_back(
          writer::FunctionBuilder(each->spelling, bytecode::FunctionKind::Function).take());
    model_.functions[1].frame_size = 100;
  }

  result::Diagnostic explained(bytecode::VerifyResult verdict) const {
    const result::Diagnostic unplaced{"B0100", result::Severity::Error, {}, "refused", {}};
    return limits_.explained({verdict, {unplaced}}, model_, functions_).front();
  }

  source::SourceSet sources_;
  semantics::Pou first_;
  semantics::Pou second_;
  std::vector<const semantics::Pou*> functions_ = {&first_, &second_};
  writer::ContainerModel model_;
  ContainerLimits limits_;
};

TEST_F(Refused, Explained_WhenACallChainNeedsTooMuch_ThenTheFunctionIsTold) {
  const auto told = explained({bytecode::VerifyStatus::TooLarge, Section::Functions, 1, 0});
  EXPECT_EQ(told.code, "E0209");
  EXPECT_EQ(told.where.line, 3u);
  EXPECT_NE(told.message.find("'second'"), std::string::npos);
}

TEST_F(Refused, Explained_WhenTheFileIsTooLarge_ThenTheProgramIsTold) {
  const auto told = explained({bytecode::VerifyStatus::TooLarge, Section::Code, 0, 0});
  EXPECT_EQ(told.code, "E0209");
  EXPECT_EQ(told.where.line, 1u);
}

TEST_F(Refused, Explained_WhenTheMemoryIsTooLarge_ThenTheFunctionWithTheMostIsTold) {
  const auto told = explained({bytecode::VerifyStatus::TooLarge, Section::Sizes, 0, 0});
  EXPECT_EQ(told.code, "E0209");
  EXPECT_EQ(told.where.line, 3u);
}

TEST_F(Refused, Explained_WhenItIsNoMatterOfSize_ThenTheVerifierSpeaks) {
  EXPECT_EQ(explained({bytecode::VerifyStatus::StackType, Section::Functions, 1, 0}).code, "B0100");
}

TEST(ContainerLimits, Text_WhenItIsTooLong_ThenItIsCutBehindAWholeCharacter) {
  const source::SourceSet sources;
  ContainerLimits limits(sources);
  for (std::size_t lead = 0; lead < 4; ++lead) {
    std::string text(lead, 'x');
    while (text.size() <= bytecode::kMaxTextBytes) text += "\u20AC";
    const std::string cut = limits.text(text);
    EXPECT_LE(cut.size(), bytecode::kMaxTextBytes);
    EXPECT_GT(cut.size(), bytecode::kMaxTextBytes - 4);
    EXPECT_TRUE(cut.ends_with("\u20AC ..."));
    EXPECT_TRUE(bytecode::is_utf8(cut));
  }
}

TEST(ContainerLimits, Text_WhenItIsNoUtf8_ThenTheBytesThatAreNoneAreReplaced) {
  const source::SourceSet sources;
  ContainerLimits limits(sources);
  EXPECT_EQ(limits.text("a = 'K\xE4se'"), "a = 'K?se'");
  EXPECT_EQ(limits.text("\u00E4\xE2\x82\u20AC\xFF"), "\u00E4??\u20AC?");
  EXPECT_EQ(ContainerLimits::name("\xE4.st"), "?.st");
}

// 400 instances of a block whose chart has a condition of 70,000 bytes: more than all long texts may take.
TEST(ContainerLimits, Conditions_WhenTheyAreLong_ThenViewersSeeTheirBeginning) {
  std::string text =
      "FUNCTION_BLOCK b VAR_INPUT a : BOOL; END_VAR INITIAL_STEP S: END_STEP STEP T: END_STEP\n"
      "TRANSITION FROM S TO T := a";
  for (int i = 0; i < 14'000; ++i) text += " OR a";
  text +=
      "; END_TRANSITION TRANSITION FROM T TO S := NOT a; END_TRANSITION END_FUNCTION_BLOCK\nPROGRAM main "
      "VAR ";
  for (int i = 0; i < 400; ++i) text += (i > 0 ? ", b" : "b") + std::to_string(i);
  driver::CompileInput input;
  input.texts.push_back({"plc.st", text + " : b; END_VAR b0(a := TRUE); END_PROGRAM\n"});
  support::CompiledProgram program(input);
  const auto& container = program.loaded().program().container();
  const auto length = [&](std::uint32_t transition) {
    return container.record<Section::SfcTransitions>(transition).condition.length;
  };
  ASSERT_EQ(container.count<Section::SfcTransitions>(), 800u);
  EXPECT_EQ(length(0), bytecode::kMaxTextBytes);
  EXPECT_EQ(length(798), bytecode::kMaxStringBytes);
  for (int i = 0; i < 3; ++i) ASSERT_FALSE(program.scan().trap);
  EXPECT_EQ(program.get("main.b0.T_X"), 1);
}

}  // namespace

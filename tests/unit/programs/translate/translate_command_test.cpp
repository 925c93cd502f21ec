#include "programs/translate/translate_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace stepwright::translate_command {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::filesystem::path kBench = STEPWRIGHT_SOURCE_DIR "/tests/cells/bench";

Arguments bench(const std::string& to, const std::string& plan = "metric_ff.plan") {
  Arguments arguments;
  arguments.plan = kBench / "plans" / plan;
  arguments.binding = kBench / "binding.toml";
  arguments.to = to;
  return arguments;
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(TranslateFiles, WhenEachFormatIsAsked_ThenTheBenchPlanIsWrittenInIt) {
  const auto sfc = translate_files(bench("sfc"));
  ASSERT_TRUE(sfc) << to_string(sfc.error());
  EXPECT_THAT(sfc->document, HasSubstr("S19_FINAL_ORDER"));
  EXPECT_THAT(sfc->summary, HasSubstr("strictly sequential"));
  Arguments drawing = bench("sfc");
  drawing.output = "chart.svg";
  EXPECT_THAT(translate_files(drawing)->document, StartsWith("<svg"));
  EXPECT_THAT(translate_files(bench("ladder"))->document, HasSubstr("S1_filtered"));
  const auto xml = translate_files(bench("plcopen"));
  ASSERT_TRUE(xml) << to_string(xml.error());
  EXPECT_THAT(xml->document, HasSubstr("http://www.plcopen.org/xml/tc6_0201"));
}

TEST(TranslateFiles, WhenOmronIsAsked_ThenThePapersAddressesAreUsed) {
  const auto omron = translate_files(bench("omron"));
  ASSERT_TRUE(omron) << to_string(omron.error());
  // Step 1 starts from the initial snapshot; the load stops at D100 (level 10 less what runs out).
  EXPECT_THAT(omron->document, HasSubstr("LD W10.01\nAND>=S(327) D100 +3710\nOUT W20.01"));
  EXPECT_THAT(omron->document, HasSubstr("OUT 1.02"));
}

TEST(TranslateFiles, WhenSequentialIsAsked_ThenNoBranchesAreLeft) {
  Arguments arguments = bench("sfc");
  arguments.sequential = true;
  const auto made = translate_files(arguments);
  ASSERT_TRUE(made);
  EXPECT_THAT(made->document, ::testing::Not(HasSubstr("W03_09")));
}

TEST(TranslateFiles, WhenPlanIsInvalid_ThenNamesTheFailingStep) {
  const auto made = translate_files(bench("sfc", "sgplan6_printed.plan"));
  ASSERT_FALSE(made);
  EXPECT_THAT(to_string(made.error()), HasSubstr("step 18"));
  EXPECT_TRUE(translate_files(bench("sfc", "sgplan6_corrected.plan")));
}

TEST(TranslateFiles, WhenAnyFileIsMissing_ThenNamesIt) {
  for (std::filesystem::path Arguments::*file :
       {&Arguments::plan, &Arguments::binding, &Arguments::domain, &Arguments::problem}) {
    Arguments arguments = bench("sfc");
    arguments.domain = kBench / "domain.pddl";
    arguments.problem = kBench / "problem.pddl";
    arguments.*file = "no/such/file";
    const auto made = translate_files(arguments);
    ASSERT_FALSE(made);
    EXPECT_THAT(to_string(made.error()), HasSubstr("no/such/file"));
  }
}

TEST(TranslateFiles, WhenBindingNamesAnUnknownTag_ThenFailsAtItsPlace) {
  std::string text = text_of(kBench / "binding.toml");
  text.replace(text.find("outputs = [\"B1\"]"), 16, "outputs = [\"B9\"]");
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / "translate_unknown_tag.toml";
  std::ofstream(file) << text;
  Arguments arguments = bench("sfc");
  arguments.binding = file;
  arguments.domain = kBench / "domain.pddl";
  arguments.problem = kBench / "problem.pddl";
  const auto made = translate_files(arguments);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().front().code, "B0007");
  EXPECT_THAT(to_string(made.error()), HasSubstr("translate_unknown_tag.toml:"));
  std::filesystem::remove(file);
}

TEST(WriteDocument, WhenFolderIsMissing_ThenFailsAndLeavesNothing) {
  const auto written = write_document("no/such/folder/chart.txt", "text");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().front().code, "T0020");
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "translate_document.txt";
  ASSERT_TRUE(write_document(file, "text"));
  EXPECT_EQ(text_of(file), "text");
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  std::filesystem::remove(file);
}

TEST(TranslateFiles, WhenAHandshakeIsAsked_ThenEveryActionHasAGateAndTheTableNamesIt) {
  Arguments arguments = bench("plcopen");
  arguments.handshake = "table.json";
  const auto made = translate_files(arguments);
  ASSERT_TRUE(made) << to_string(made.error());
  const auto table = nlohmann::json::parse(made->table);
  EXPECT_EQ(table["registers"], 1024);
  ASSERT_EQ(table["actions"].size(), 19u);
  for (const auto& action : table["actions"]) {
    const std::string step = action["step"];
    EXPECT_THAT(made->document, HasSubstr("\"G" + step.substr(1) + "\""));
    for (const int before : action["after"]) EXPECT_LT(before, action["number"]);
  }
  EXPECT_EQ(table["actions"][0]["after"].size(), 0u);
  EXPECT_THAT(made->document, HasSubstr("%MW4"));
}

TEST(TranslateFiles, WhenAHandshakeIsAskedForOmron_ThenItsRegistersAreMemoryWords) {
  Arguments arguments = bench("omron");
  arguments.handshake = "table.json";
  const auto made = translate_files(arguments);
  ASSERT_TRUE(made) << to_string(made.error());
  EXPECT_THAT(made->document, HasSubstr("<>S(307) D300 +0"));  // nothing but 0 lets gates open
  EXPECT_THAT(made->document, HasSubstr("D304"));
  EXPECT_THAT(translate_files(bench("omron"))->document, ::testing::Not(HasSubstr("D300")));
}

}  // namespace
}  // namespace stepwright::translate_command

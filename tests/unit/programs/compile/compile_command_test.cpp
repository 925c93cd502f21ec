// The command `compile`: what it writes where, and what can be checked.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/unit/programs/compile/compile_program.h"

namespace stepwright::compile_test {
namespace {

using testing::HasSubstr;
using testing::Not;

using CompileCommand = CompileProgram;

constexpr const char* kMain =
    "PROGRAM main\nVAR n : INT; m : INT; END_VAR\nn := n + 1; m := 2 * n;\nEND_PROGRAM\n";

TEST_F(CompileCommand, WhenTheReportGoesToADash_ThenItIsStandardOutput) {
  const std::string source = write("main.st", kMain);
  ASSERT_EQ(run("compile " + source + " -o " + path("main.swb") + " --json -"), 0) << errors;
  const auto report = nlohmann::json::parse(output);
  EXPECT_TRUE(report["diagnostics"].empty());
  EXPECT_EQ(report["bytes"], std::filesystem::file_size(path("main.swb")));
  EXPECT_FALSE(std::filesystem::exists("-"));
  ASSERT_EQ(run_program("stepwright-exec", path("main.swb") + " --scans 2 --json -"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("image_hash"));
}

// Editors of Windows write one.
TEST_F(CompileCommand, WhenASourceBeginsWithAByteOrderMark_ThenItIsNone) {
  const std::string source = write("main.st", std::string("\xEF\xBB\xBF") + kMain);
  ASSERT_EQ(run("compile " + source + " -o " + path("marked.swb")), 0) << errors;
  ASSERT_EQ(run("compile " + write("main.st", kMain) + " -o " + path("plain.swb")), 0) << errors;
  EXPECT_EQ(text("marked.swb"), text("plain.swb"));
  EXPECT_EQ(run("compile --check " + write("wrong.st", "\xEF\xBB\xBFPROGRAM m\nx := 1;\nEND_PROGRAM\n")), 1);
  EXPECT_THAT(errors, HasSubstr("wrong.st:2:1: "));
}

// A slip of the fingers costs nobody a file.
TEST_F(CompileCommand, WhenAnOutputIsASource_ThenItStays) {
  const std::string source = write("main.st", kMain);
  const std::string notes = write("notes.txt", "of somebody");
  const auto size = std::filesystem::file_size(source);
  const std::pair<std::string, int> wrong[] = {{" -o " + source, 2},
                                               {" -o " + path("./main.st"), 2},
                                               {" -o " + notes, 1},
                                               {" --check --json " + source, 2},
                                               {" --check --json=" + notes, 2}};
  for (const auto& [outputs, exit] : wrong) {
    EXPECT_EQ(run("compile " + source + outputs), exit) << outputs;
    EXPECT_THAT(errors, HasSubstr("E0004")) << outputs;
    EXPECT_EQ(std::filesystem::file_size(source), size) << outputs;
    EXPECT_EQ(std::filesystem::file_size(notes), 11u) << outputs;
  }
  for (int round = 0; round < 2; ++round)
    EXPECT_EQ(run("compile " + source + " -o " + path("main.swb") + " --json " + path("r.json")), 0)
        << errors;
}

// As a shell opens it: what stands there is added to.
TEST_F(CompileCommand, WhenAStreamLeadsToAFile_ThenAReportIsAddedToIt) {
  const std::string source = write("main.st", kMain);
  write("log.txt", "the one before\n");
  EXPECT_EQ(run("compile --check " + source + " --json /dev/fd/3 3>>" + path("log.txt")), 0) << errors;
  EXPECT_GT(std::filesystem::file_size(path("log.txt")), 20u);
}

TEST_F(CompileCommand, WhenOptionsStandBetweenSources_ThenEachTakesOneValue) {
  const std::string source = write("main.st", kMain);
  const std::string block = write("block.st", "FUNCTION f : INT\nf := 1;\nEND_FUNCTION\n");
  EXPECT_EQ(run("compile -W all " + source + " -o " + path("main.swb") + " " + block), 0) << errors;
  EXPECT_THAT(errors, HasSubstr("W0005"));
  EXPECT_EQ(run_program("stepwright-exec", "--scans 2 --trace main.n,main.m " + path("main.swb")), 0)
      << errors;
}

TEST_F(CompileCommand, WhenALibraryIsChecked_ThenItNeedsNoProgramAndNoImageIsWritten) {
  const std::string library = write(
      "library.st", "FUNCTION twice : INT\nVAR_INPUT n : INT; END_VAR\ntwice := 2 * n;\nEND_FUNCTION\n");
  EXPECT_EQ(run("compile --check " + library), 0) << errors;
  EXPECT_EQ(run("compile --check --json - " + library), 0) << errors;
  EXPECT_EQ(nlohmann::json::parse(output)["bytes"], 0);
  EXPECT_EQ(run("compile " + library + " -o " + path("library.swb")), 1);
  EXPECT_THAT(errors, HasSubstr("E0601"));
  write("library.st", "FUNCTION twice : INT\nVAR_INPUT n : INT; END_VAR\ntwice := 2 * m;\nEND_FUNCTION\n");
  EXPECT_EQ(run("compile --check " + library), 1);
  EXPECT_THAT(errors, HasSubstr("E0201"));
  EXPECT_EQ(run("compile " + library), 2);
}

TEST_F(CompileCommand, WhenADialectIsNamed_ThenItsSourcesAreTaken) {
  const std::string source =
      write("main.st", "PROGRAM main\nVAR_INPUT n : INT; END_VAR\nn := n + 1;\nEND_PROGRAM\n");
  EXPECT_EQ(run("compile " + source + " -o " + path("main.swb")), 1);
  EXPECT_THAT(errors, HasSubstr("--dialect matiec and codesys take it"));
  EXPECT_EQ(run("compile --dialect matiec " + source + " -o " + path("main.swb")), 0) << errors;
  EXPECT_THAT(errors, HasSubstr("W0019"));
  EXPECT_EQ(run("compile --dialect basic " + source + " -o " + path("main.swb")), 2);
}

TEST_F(CompileCommand, WhenAConfigurationIsChosen_ThenAPlcopenFileMustHaveIt) {
  const auto program = [](const std::string& name) {
    return "<pou name=\"" + name +
           "\" pouType=\"program\"><interface><localVars><variable name=\"n\"><type><INT/>" +
           "</type></variable></localVars></interface><body><ST><xhtml "
           "xmlns=\"http://www.w3.org/1999/xhtml\">" +
           "n := n + 1;</xhtml></ST></body></pou>";
  };
  const auto device = [](const std::string& name, const std::string& runs) {
    return "<configuration name=\"" + name + "\"><resource name=\"r\"><task name=\"t\" priority=\"0\" " +
           "interval=\"T#20ms\"><pouInstance name=\"p\" typeName=\"" + runs +
           "\"/></task></resource></configuration>";
  };
  const std::string plant = write(
      "plant.xml",
      "<project xmlns=\"http://www.plcopen.org/xml/tc6_0201\"><fileHeader companyName=\"c\" "
      "productName=\"p\" "
      "productVersion=\"1\" creationDateTime=\"2026-01-01T00:00:00\"/><contentHeader "
      "name=\"plant\"><coordinateInfo>"
      "<fbd><scaling x=\"1\" y=\"1\"/></fbd><ld><scaling x=\"1\" y=\"1\"/></ld><sfc><scaling x=\"1\" "
      "y=\"1\"/></sfc>"
      "</coordinateInfo></contentHeader><types><dataTypes/><pous>" +
          program("mix") + program("pack") + "</pous></types><instances><configurations>" +
          device("Mixer", "mix") + device("Packer", "pack") + "</configurations></instances></project>");
  const std::string result = " -o " + path("plant.swb");
  EXPECT_EQ(run("compile " + plant + result), 1);
  EXPECT_THAT(errors, HasSubstr("'Mixer' and 'Packer'"));
  EXPECT_THAT(errors, HasSubstr("--configuration NAME"));
  EXPECT_EQ(run("compile --configuration packer " + plant + result), 0) << errors;
  EXPECT_EQ(run_program("stepwright-exec", "--scans 2 --trace p.n " + path("plant.swb")), 0) << errors;
  EXPECT_EQ(run("compile --configuration Press " + plant + result), 1);
  EXPECT_THAT(errors, HasSubstr("the file has 'Mixer' and 'Packer'"));
  const std::string text = write("main.st", kMain);
  EXPECT_EQ(run("compile --configuration Packer " + text + result), 1);
  EXPECT_THAT(errors, HasSubstr("PLCopen file"));
}

}  // namespace
}  // namespace stepwright::compile_test

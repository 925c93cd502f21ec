// `stepwright test`: exit codes, what it prints, its reports.

#include <gmock/gmock.h>

#include <fstream>
#include <pugixml.hpp>
#include <sstream>

#include "tests/unit/programs/test/test_command.h"

namespace stepwright::test_program {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kPump = R"(FUNCTION_BLOCK PumpControl
  VAR_INPUT start : BOOL; END_VAR
  VAR_OUTPUT run : BOOL; END_VAR
  VAR delay : TON; END_VAR
  delay(IN := start, PT := T#2s);
  run := delay.Q;
END_FUNCTION_BLOCK
)";

constexpr const char* kTests = R"(TEST 'a pump starts'
  VAR pump : PumpControl; END_VAR
  pump(start := TRUE);
  ADVANCE_TIME(T#2s);
  pump(start := TRUE);
  ASSERT_TRUE(pump.run, 'pump must run');
END_TEST

TEST 'a pump stops & <rests>'
  VAR pump : PumpControl; END_VAR
  pump(start := TRUE);
  ADVANCE_TIME(T#2s);
  pump(start := FALSE);
  ASSERT_EQ(pump.delay.ET, T#1s, 'wrong on purpose');
END_TEST
)";

TEST_F(TestCommand, Run_WhenAllPass_ThenExitsWithZero) {
  const std::string file = write("a.st", std::string(kPump) + kTests);
  EXPECT_EQ(run(file + " --filter '*starts'"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("ok    a pump starts  (T#2s)\n1 test: 1 ok, 0 failed, 1 left out"));
  EXPECT_EQ(errors, "");
  const auto json = report();
  EXPECT_EQ(json["passed"], 1);
  EXPECT_EQ(json["left_out"], 1);
  EXPECT_EQ(json["simulated_s"], 2.0);
  EXPECT_EQ(json["tests"][0]["simulated_ns"], 2'000'000'000);
  EXPECT_EQ(json["tests"][0]["line"], 8);
}

TEST_F(TestCommand, Run_WhenTestsStandInAFileOfTheirOwn_ThenFailuresNameIt) {
  const std::string sources = write("pump.st", kPump) + " " + write("pump_tests.st", kTests);
  EXPECT_EQ(run(sources), 1);
  EXPECT_THAT(
      output,
      HasSubstr("pump_tests.st:14:3: error: ASSERT_EQ: pump.delay.ET is T#0s, expected T#1s: wrong on "
                "purpose\n  14 |   ASSERT_EQ(pump.delay.ET, T#1s, 'wrong on purpose');\n     |   ^\n"));
  EXPECT_THAT(output, HasSubstr("2 tests: 1 ok, 1 failed"));
  const auto failure = report()["tests"][1]["failure"];
  EXPECT_EQ(failure["statement"], "ASSERT_EQ");
  EXPECT_EQ(failure["expression"], "pump.delay.ET");
  EXPECT_EQ(failure["actual"], "T#0s");
  EXPECT_EQ(failure["expected"], "T#1s");
  EXPECT_EQ(failure["message"], "wrong on purpose");
}

TEST_F(TestCommand, Junit_WhenATestFails_ThenTheFileCountsAndNamesIt) {
  const std::string file = write("a.st", std::string(kPump) + kTests);
  EXPECT_EQ(run(file + " --junit " + path("junit.xml")), 1);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file(path("junit.xml").c_str()));
  const pugi::xml_node root = document.child("testsuites");
  EXPECT_EQ(root.attribute("tests").as_int(), 2);
  EXPECT_EQ(root.attribute("failures").as_int(), 1);
  EXPECT_EQ(root.attribute("errors").as_int(), 0);
  const pugi::xml_node suite = root.child("testsuite");
  EXPECT_EQ(suite.attribute("name").as_string(), file);
  EXPECT_EQ(suite.attribute("failures").as_int(), 1);
  const pugi::xml_node second = suite.child("testcase").next_sibling("testcase");
  EXPECT_STREQ(second.attribute("name").as_string(), "a pump stops & <rests>");
  EXPECT_EQ(second.attribute("line").as_int(), 16);
  EXPECT_STREQ(second.child("failure").attribute("type").as_string(), "ASSERT_EQ");
  EXPECT_THAT(second.child("failure").attribute("message").as_string(), HasSubstr("is T#0s, expected T#1s"));
  EXPECT_TRUE(suite.child("testcase").child("failure").empty());
}

TEST_F(TestCommand, Junit_WhenTextsAreNoXml_ThenTheFileIsStillRead) {
  const std::string file = write(
      "a.st", "TEST 'a\x01\xFF]]>'\n VAR s : STRING := '$07<b>'; END_VAR\n ASSERT_EQ(s, '&');\nEND_TEST\n");
  EXPECT_EQ(run(file + " --junit " + path("junit.xml")), 1) << errors;
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file(path("junit.xml").c_str()));
  EXPECT_STREQ(
      document.child("testsuites").child("testsuite").child("testcase").attribute("name").as_string(),
      "a??]]>");
}

TEST_F(TestCommand, Run_WhenTheSourcesAreWrong_ThenNothingRunsAndEachMistakeIsSaid) {
  const std::string file =
      write("a.st", "TEST 'one'\n ASSERT_TRUE(5);\nEND_TEST\nTEST 'two'\n x := 1;\nEND_TEST\n");
  EXPECT_EQ(run(file + " --junit " + path("junit.xml")), 1);
  EXPECT_THAT(errors, HasSubstr("a.st:2:14: error E0301"));
  EXPECT_THAT(errors, HasSubstr("a.st:5:2: error E0201"));
  EXPECT_TRUE(report()["tests"].empty());
  EXPECT_EQ(report()["diagnostics"].size(), 2u);
  pugi::xml_document document;
  ASSERT_TRUE(document.load_file(path("junit.xml").c_str()));
  EXPECT_EQ(document.child("testsuites").attribute("errors").as_int(), 1);
  EXPECT_FALSE(document.child("testsuites").child("testsuite").child("testcase").child("error").empty());
}

TEST_F(TestCommand, Run_WhenThereIsNothingToRun_ThenSaysWhatIsMissing) {
  const std::string none = write("none.st", kPump);
  EXPECT_EQ(run(none), 1);
  EXPECT_THAT(errors, HasSubstr("there is no TEST in the sources"));
  EXPECT_THAT(errors, HasSubstr("END_TEST"));
  const std::string some = write("some.st", std::string(kPump) + kTests);
  EXPECT_EQ(run(some + " --filter valve"), 1);
  EXPECT_THAT(errors, HasSubstr("no test has a name like 'valve'"));
  EXPECT_EQ(run(path("missing.st")), 1);
  EXPECT_THAT(errors, HasSubstr("E0001"));
}

TEST_F(TestCommand, Run_WhenTheCommandLineIsWrong_ThenExitsWithTwo) {
  EXPECT_EQ(run(""), 2);
  EXPECT_EQ(run(write("a.st", kTests) + " --engine fast"), 2);
}

TEST_F(TestCommand, Run_WhenThroughTheOneCommand_ThenItIsTheSame) {
  const std::string file = write("a.st", std::string(kPump) + kTests);
  EXPECT_EQ(run_program("stepwright", "test " + file + " --filter '*starts'"), 0) << errors;
  EXPECT_THAT(output, HasSubstr("ok    a pump starts"));
}

TEST_F(TestCommand, Run_WhenScansAreBounded_ThenTheFlagRaisesTheBound) {
  const std::string file =
      write("a.st",
            "PROGRAM p\n VAR n : DINT; END_VAR\n n := n + 1;\nEND_PROGRAM\n"
            "TEST 'long'\n RUN_SCANS(50); RUN_SCANS(51);\n ASSERT_EQ(p.n, 101);\nEND_TEST\n");
  EXPECT_EQ(run(file + " --max-scans 100"), 1);
  EXPECT_THAT(output, HasSubstr("a test has at most 100"));
  EXPECT_THAT(output, HasSubstr("--max-scans"));
  EXPECT_EQ(run(file + " --max-scans 101"), 0) << output;
  EXPECT_THAT(output, HasSubstr("(T#1s, 101 scans)"));
}

TEST_F(TestCommand, Run_WhenThereAreManyTests_ThenEachLineSaysHowFarItIs) {
  std::string text = kPump;
  for (int i = 0; i < 1000; ++i)
    text += "TEST 'number " + std::to_string(i) +
            "'\n VAR p : PumpControl; i : INT; END_VAR\n p(start := TRUE);\n"
            " FOR i := 1 TO 10 DO ADVANCE_TIME(T#200ms); END_FOR;\n p(start := TRUE);\n "
            "ASSERT_TRUE(p.run);\nEND_TEST\n";
  EXPECT_EQ(run(write("a.st", text)), 0) << errors;
  EXPECT_THAT(output, HasSubstr("[  37/1000] ok    number 36  (T#2s)\n"));
  EXPECT_THAT(output, HasSubstr("1000 tests: 1000 ok, 0 failed; 2000 s simulated"));
  EXPECT_EQ(report()["passed"], 1000);
}

TEST_F(TestCommand, Run_WhenATestIsLongAndWaitsOften_ThenItStaysWithinItsBudget) {
  std::string text = "TEST 'long'\n VAR n : DINT; END_VAR\n";
  for (int i = 1; i <= 2000; ++i)
    text += " ADVANCE_TIME(T#1ms); n := n + 1; ASSERT_EQ(n, " + std::to_string(i) + ");\n";
  EXPECT_EQ(run(write("a.st", text + "END_TEST\n")), 0) << output << errors;
  EXPECT_EQ(report()["tests"][0]["simulated_ns"], 2'000'000'000);
}

// The example of README.md prints what is written there, up to the time it takes.
TEST_F(TestCommand, Readme_WhenItsExampleRuns_ThenItSaysWhatIsWritten) {
  std::ostringstream readme;
  readme << std::ifstream(STEPWRIGHT_SOURCE_DIR "/README.md").rdbuf();
  const std::string page = readme.str();
  const auto between = [&](const std::string& begin, const std::string& end) {
    const std::size_t at = page.find(begin) + begin.size();
    return page.substr(at, page.find(end, at) - at);
  };
  const std::string printed = between("$ stepwright test plant.st --junit report.xml\n", " in 0.");
  ASSERT_THAT(printed, HasSubstr("2 tests: 2 ok"));
  EXPECT_EQ(run(write("plant.st", between("```st\n", "```"))), 0) << errors;
  EXPECT_THAT(output, testing::StartsWith(printed));
}

TEST_F(TestCommand, Run_WhenTheProgramIsPlcopenXml_ThenTestsBesideItSeeIt) {
  const std::string project = write("plant.xml",
                                    R"(<project xmlns="http://www.plcopen.org/xml/tc6_0201">
<fileHeader companyName="x" productName="x" productVersion="1" creationDateTime="2026-01-01T00:00:00"/>
<contentHeader name="p"><coordinateInfo><fbd><scaling x="1" y="1"/></fbd><ld><scaling x="1" y="1"/></ld>
<sfc><scaling x="1" y="1"/></sfc></coordinateInfo></contentHeader>
<types><dataTypes/><pous><pou name="Plant" pouType="program">
<interface><localVars><variable name="n"><type><INT/></type></variable></localVars></interface>
<body><ST><xhtml xmlns="http://www.w3.org/1999/xhtml">n := n + 1;</xhtml></ST></body></pou></pous></types>
<instances><configurations/></instances></project>)");
  const std::string tests =
      write("t.st", "TEST 'it counts'\n RUN_SCANS(3);\n ASSERT_EQ(plant.n, 3);\nEND_TEST\n");
  EXPECT_EQ(run(project + " " + tests), 0) << output << errors;
}

// Mocks of one file change nothing for the tests of another.
TEST_F(TestCommand, Run_WhenAFileHasMocks_ThenOnlyItsTestsMeetThem) {
  const std::string under_test = write(
      "f.st", "FUNCTION F : INT\n F := 1;\nEND_FUNCTION\nFUNCTION G : INT\n G := F() + 1;\nEND_FUNCTION\n");
  const std::string plain = write("plain.st", "TEST 'plain'\n ASSERT_EQ(G(), 2);\nEND_TEST\n");
  const std::string mocked =
      write("mocked.st",
            "MOCK FUNCTION F : INT\n F := 40;\nEND_MOCK\nTEST 'mocked'\n ASSERT_EQ(G(), 41);\nEND_TEST\n");
  EXPECT_EQ(run(under_test + " " + plain + " " + mocked), 0) << output << errors;
  EXPECT_EQ(report()["passed"], 2);
}

// The image of a program does not know its tests.
TEST_F(TestCommand, Compile_WhenSourcesHoldTests_ThenTheImageIsThatWithoutThem) {
  const std::string program =
      std::string(kPump) +
      "PROGRAM main\n VAR p : PumpControl; lamp AT %QX0.0 : BOOL; END_VAR\n p(start := TRUE);\n"
      " lamp := p.run;\nEND_PROGRAM\n";
  const std::string tests =
      std::string(kTests) +
      "MOCK FUNCTION_BLOCK PumpControl\n VAR_INPUT start : BOOL; END_VAR\n VAR_OUTPUT run : BOOL; "
      "END_VAR\n run := start;\nEND_MOCK\n"
      "TEST 'more'\n VAR s : STRING[200]; END_VAR\n %IX9.0 := TRUE; RUN_SCANS(1);\n "
      "ASSERT_EQ(s, 'x');\nEND_TEST\n";
  const std::string alone = write("a.st", program);
  ASSERT_EQ(run_program("stepwright-compile", "compile " + alone + " -o " + path("alone.swb")), 0) << errors;
  write("a.st", program + tests);
  ASSERT_EQ(run_program("stepwright-compile", "compile " + alone + " -o " + path("tested.swb")), 1);
  // The test of the mock's file sees no internal delay.
  EXPECT_THAT(errors, HasSubstr("E0204"));
  const std::size_t delay = tests.find("  ASSERT_EQ(pump.delay");
  std::string right = tests;
  right.erase(delay, tests.find('\n', delay) - delay);
  write("a.st", program + right);
  ASSERT_EQ(run_program("stepwright-compile", "compile " + alone + " -o " + path("tested.swb")), 0) << errors;
  ASSERT_FALSE(text("alone.swb").empty());
  EXPECT_EQ(text("alone.swb"), text("tested.swb"));
  EXPECT_THAT(errors, Not(HasSubstr("error")));
}

}  // namespace
}  // namespace stepwright::test_program

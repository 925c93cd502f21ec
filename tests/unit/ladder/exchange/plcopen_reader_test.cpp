#include "ladder/exchange/plcopen_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "ladder/exchange/plcopen_writer.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

using ::testing::HasSubstr;

graphic::Project read(const std::string& xml) {
  auto project = read_plcopen("plc.xml", xml);
  if (!project) throw std::runtime_error(result::to_string(project.error()));
  return std::move(*project);
}

driver::CompileInput input_of(const graphic::Project& project) {
  driver::CompileInput input;
  input.projects = {&project};
  return input;
}

// Runs `scans` scans: sets inputs before, then notes the values of `outputs`.
class Running {
 public:
  explicit Running(const std::string& xml) : project_(read(xml)), program_(input_of(project_)) {}

  std::string scan(const std::string& inputs, const std::string& outputs) {
    std::istringstream in(inputs);
    for (std::string name; in >> name;)
      program_.set("run." + name.substr(name[0] == '!' ? 1 : 0), name[0] == '!' ? 0 : 1);
    EXPECT_FALSE(program_.scan().trap);
    std::istringstream out(outputs);
    std::string values;
    for (std::string name; out >> name;)
      values += (values.empty() ? "" : " ") + std::to_string(program_.get("run." + name));
    return values;
  }

 private:
  graphic::Project project_;
  support::CompiledProgram program_;
};

TEST(PlcopenReader, WhenATypeIsAnotherNameOfAString_ThenItsValuesAreLiterals) {
  const std::string types =
      "<dataType name=\"Caption\"><baseType><string/></baseType></dataType>"
      "<dataType name=\"Title\"><baseType><derived name=\"Caption\"/></baseType></dataType>\n";
  const std::string variables =
      "<variable name=\"shown\"><type><derived name=\"TITLE\"/></type>"
      "<initialValue><simpleValue value=\"ready\"/></initialValue></variable>\n";
  const graphic::Project project = read(editor_project(editor_program(variables, "<FBD>\n</FBD>\n"), types));
  EXPECT_EQ(project.pous.at(0).variables.at(0).initial, "ready");
  EXPECT_EQ(support::CompiledProgram(input_of(project)).text("run.shown"), "ready");
}

TEST(PlcopenReader, WhenATypeOfAStringStandsInAnotherFile_ThenItsValuesAreLiterals) {
  const auto value = [](const std::string& simple) {
    return "<initialValue><simpleValue value=\"" + simple + "\"/></initialValue>";
  };
  const std::string variables =
      "<variable name=\"shown\"><type><derived name=\"Caption\"/></type>" + value("blup") +
      "</variable>\n<variable name=\"colour\"><type><derived name=\"Caption\"/></type>" + value("#ff, it's") +
      "</variable>\n<variable name=\"line\"><type><derived name=\"Line\"/></type><initialValue><structValue>"
      "<value member=\"note\"><simpleValue value=\"a, "
      "b\"/></value></structValue></initialValue></variable>\n";
  const graphic::Project user = read(editor_project(editor_program(variables, "<FBD>\n</FBD>\n")));
  const auto expect_values = [&](const driver::CompileInput& input) {
    const support::CompiledProgram program(input);
    EXPECT_EQ(program.text("run.shown"), "blup");
    EXPECT_EQ(program.text("run.colour"), "#ff, it's");
    EXPECT_EQ(program.text("run.line.note"), "a, b");
    EXPECT_EQ(program.text("run.line.more"), "none");
  };
  driver::CompileInput with_text = input_of(user);
  with_text.texts.push_back(
      {"types.st",
       "TYPE Caption : STRING[30]; END_TYPE\n"
       "TYPE Line : STRUCT note : Caption; more : STRING := 'none'; END_STRUCT; END_TYPE\n"});
  expect_values(with_text);
  // A project that comes behind it.
  graphic::Project types;
  types.types = {{"Caption", "STRING[30]"},
                 {"Line", "STRUCT note : Caption; more : Caption := none; END_STRUCT"}};
  driver::CompileInput with_project = input_of(user);
  with_project.projects.push_back(&types);
  expect_values(with_project);
}

TEST(PlcopenReader, WhenLadderOfAnEditorRuns_ThenRungsTimersAndConnectorsWork) {
  Running run(editor_ladder());
  EXPECT_EQ(run.scan("start", "lamp late pulse"), "1 0 0");
  EXPECT_EQ(run.scan("!start armed", "lamp late pulse"), "1 0 0");
  EXPECT_EQ(run.scan("!armed", "lamp late pulse"), "1 0 0");
  EXPECT_EQ(run.scan("armed", "lamp late pulse"), "1 1 1");
  EXPECT_EQ(run.scan("armed", "lamp late pulse"), "1 1 0");
  EXPECT_EQ(run.scan("stop", "lamp late pulse"), "0 1 0");
}

TEST(PlcopenReader, WhenBlocksFeedBack_ThenTheVariableCarriesTheValue) {
  Running run(editor_blocks());
  EXPECT_EQ(run.scan("up", "count full"), "2 0");
  EXPECT_EQ(run.scan("!up", "count full"), "2 0");
  EXPECT_EQ(run.scan("up", "count full"), "4 0");
  EXPECT_EQ(run.scan("up", "count full"), "6 1");
}

TEST(PlcopenReader, WhenChartOfAnEditorRuns_ThenBranchesActionsAndDrawnConditionsWork) {
  Running run(editor_chart());
  const std::string outputs = "left_on lefts noted slow";
  EXPECT_EQ(run.scan("", outputs), "0 0 0 0");
  EXPECT_EQ(run.scan("go west", outputs), "1 1 0 0");  // both conditions hold: the left branch goes first
  EXPECT_EQ(run.scan("!west", outputs), "1 1 0 0");
  EXPECT_EQ(run.scan("done", outputs), "0 1 0 0");
  EXPECT_EQ(run.scan("!go", outputs), "0 1 0 0");
  EXPECT_EQ(run.scan("go", outputs), "0 1 1 0");
  EXPECT_EQ(run.scan("", outputs), "0 1 1 0");
  EXPECT_EQ(run.scan("", outputs), "0 1 1 1");
}

// What another system brings along and what is not supported: said once for each POU, and the rest is
// checked.
TEST(PlcopenReader, WhenPousNeedWhatIsNotThere_ThenEachSaysSoOnceAndTheRestIsChecked) {
  const auto pou = [](const std::string& name, const std::string& variables, const std::string& body) {
    std::string text = editor_program(variables, body);
    return text.replace(text.find("name=\"main\""), 11, "name=\"" + name + "\"");
  };
  const auto derived = [](const std::string& name, const std::string& type) {
    return "<variable name=\"" + name + "\"><type><derived name=\"" + type + "\"/></type></variable>\n";
  };
  const auto st = [](const std::string& text) {
    return "<ST><xhtml:p><![CDATA[" + text + "]]></xhtml:p></ST>\n";
  };
  const std::string hmi =
      derived("level", "HMI_INT") + derived("eval", "python_eval") + derived("name", "HMI_INT") + bools("ok");
  const std::string xml = editor_project(
      pou("main", hmi,
          st("level := 3;\neval(TRIG := ok, CODE := 'x');\nname := level + 1;\nok := eval.ACK;")) +
      pou("list", bools("a b"), "<IL><xhtml:p><![CDATA[LD a\nST b]]></xhtml:p></IL>\n") +
      pou("typo", derived("delay", "TONN"), st("delay(IN := TRUE, PT := T#1s);")) +
      pou("wrong", bools("a"), st("a := nowhere;")));
  const graphic::Project project = read(xml);
  const auto output = driver::compile(input_of(project));
  ASSERT_FALSE(output);
  std::string all;
  for (const result::Diagnostic& each : output.error()) {
    EXPECT_EQ(each.where.file, "plc.xml");
    EXPECT_GT(each.where.line, 1U);
    EXPECT_EQ(each.hint.empty(), each.code == "E0201") << each.message;
    all += each.code + " " + each.message + "\n";
  }
  EXPECT_THAT(all, HasSubstr("E0203 POU 'main': the types 'HMI_INT', 'python_eval' are declared nowhere\n"));
  EXPECT_THAT(all, HasSubstr("E0203 POU 'typo': the type 'TONN' is declared nowhere\n"));
  EXPECT_THAT(all, HasSubstr("E0804 "));
  EXPECT_THAT(all, HasSubstr("E0201 "));
  EXPECT_EQ(output.error().size(), 4U) << all;
}

// The instructions of a project's container: its source map names the lines of the file.
std::string code_of(const graphic::Project& project) {
  const support::CompiledProgram program(input_of(project));
  const auto code = program.loaded().program().container().section(bytecode::Section::Code);
  return {reinterpret_cast<const char*>(code.data()), code.size()};
}

class RoundTrip : public testing::TestWithParam<std::string (*)()> {};

TEST_P(RoundTrip, WhenWrittenReadAndWritten_ThenTheBytesAreEqual) {
  const auto first = write_plcopen(read(GetParam()()));
  ASSERT_TRUE(first) << result::to_string(first.error());
  const auto second = write_plcopen(read(*first));
  ASSERT_TRUE(second);
  EXPECT_EQ(*first, *second);
}

TEST_P(RoundTrip, WhenWrittenAndRead_ThenTheProgramIsTheSame) {
  const graphic::Project original = read(GetParam()());
  const graphic::Project copy = read(*write_plcopen(original));
  EXPECT_EQ(code_of(original), code_of(copy));
}

INSTANTIATE_TEST_SUITE_P(Projects, RoundTrip, testing::Values(editor_ladder, editor_blocks, editor_chart));

TEST(PlcopenReader, WhenAnotherEncodingIsDeclared_ThenItsCharactersAreRead) {
  std::string xml =
      editor_project(editor_program("<variable name=\"a\"><type><BOOL/></type><documentation><xhtml:p>20 \xB0"
                                    "C, 5 \x80, caf\xE9"
                                    "</xhtml:p></documentation></variable>\n",
                                    "<FBD>\n</FBD>\n"));
  xml.replace(xml.find("utf-8"), 5, "iso-8859-1");
  EXPECT_EQ(read(xml).pous.at(0).variables.at(0).comment, "20 °C, 5 €, café");
}

struct BadCase {
  const char* name;
  std::string text;
  const char* code;
  const char* message;
  std::uint32_t line;
};

class BadFile : public testing::TestWithParam<BadCase> {};

TEST_P(BadFile, WhenRead_ThenTheMistakeIsLocated) {
  const auto project = read_plcopen("plc.xml", GetParam().text);
  ASSERT_FALSE(project);
  const result::Diagnostic& first = project.error().front();
  EXPECT_EQ(first.code, GetParam().code);
  EXPECT_THAT(first.message, HasSubstr(GetParam().message));
  EXPECT_EQ(first.where.file, "plc.xml");
  EXPECT_EQ(first.where.line, GetParam().line) << first.message;
}

std::string deep(int levels) {
  std::string text = "<project>\n";
  for (int i = 0; i < levels; ++i) text += "<a>";
  for (int i = 0; i < levels; ++i) text += "</a>";
  return text + "</project>";
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadFile,
    testing::Values(
        BadCase{"Empty", "", "E0801", "no well-formed XML", 1},
        BadCase{"CutOff", "<project>\n<types>", "E0801", "no well-formed XML", 2},
        BadCase{"Entities", "<!DOCTYPE p [<!ENTITY a \"b\">]>\n<project/>", "E0801", "document types", 1},
        BadCase{"Utf16", "\xFF\xFE<", "E0801", "not UTF-8", 1},
        BadCase{"NoUtf8",
                "<project>\n<a>\xB0"
                "C</a></project>",
                "E0801", "not of UTF-8", 2},
        BadCase{"Encoding", "<?xml version=\"1.0\" encoding=\"Shift_JIS\"?>\n<project/>", "E0801",
                "'Shift_JIS' is not read", 1},
        BadCase{"Deep", deep(1000), "E0801", "nested too deeply", 2},
        BadCase{"NoProject", "\n<plan/>", "E0802", "no PLCopen project", 2},
        BadCase{"NoTypes", "<project/>", "E0802", "<project> has no child <fileHeader>", 1},
        BadCase{"PouKind", editor_project("<pou name=\"a\" pouType=\"class\"><body><ST/></body></pou>"),
                "E0802", "no kind of POU 'class'", 21},
        BadCase{"NoName", editor_project("\n<pou pouType=\"program\"><body><ST/></body></pou>"), "E0802",
                "no attribute 'name'", 22},
        BadCase{"NameOfTwoWords",
                editor_project("\n<pou name=\"My Prog\" pouType=\"program\"><body><ST/></body></pou>"),
                "E0802", "'My Prog' of <pou> is no name", 22},
        BadCase{"VariableOfTwoWords",
                editor_project(editor_program("<variable name=\"a b\"><type><BOOL/></type></variable>\n",
                                              "<FBD>\n</FBD>\n")),
                "E0802", "'a b' of <variable> is no name", 24},
        BadCase{"NoLanguage", editor_project("<pou name=\"a\" pouType=\"program\"><body/></pou>"), "E0802",
                "in no language", 21},
        BadCase{"NoNumber",
                editor_project(editor_program(bools("a"),
                                              "<LD>\n<coil localId=\"x\"><position x=\"0\" y=\"0\"/>"
                                              "<variable>a</variable></coil></LD>")),
                "E0802", "localId=\"x\" is no number", 33},
        BadCase{"Unknown", editor_project(editor_program(bools("a"), "<LD>\n<relay localId=\"1\"/></LD>")),
                "E0802", "<relay> is no element", 33}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace stepwright::exchange

// The rules of the schema: what we write keeps all of them, and a file that breaks one is refused with a
// place.

#include "ladder/exchange/plcopen_schema.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "ladder/exchange/plcopen_reader.h"
#include "ladder/exchange/plcopen_writer.h"
#include "ladder/lowering/sfc_to_ladder.h"
#include "tests/support/sample_charts.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"
#include "tests/unit/ladder/lowering/random_chart.h"

namespace stepwright::exchange {
namespace {

using ::testing::HasSubstr;

std::string faults(const std::string& xml) {
  pugi::xml_document document;
  if (!document.load_string(xml.c_str())) return "no XML";
  std::string text;
  for (const plcopen::SchemaFault& each :
       plcopen::schema_faults(document.document_element(), plcopen::Strictness::Complete))
    text += each.message + "\n";
  return text;
}

graphic::Project rich_project() {
  graphic::Project project;
  project.types = {{"Line", "STRUCT text : STRING[20] := abc; size AT %MW0 : INT(0..9) := 3; END_STRUCT"},
                   {"Color", "INT (red := 1, green)", "green", "a colour"},
                   {"Table", "ARRAY[0..3, 1..2] OF REF_TO Line"}};
  project.globals = {
      {"lines", "ARRAY[1..2] OF Line", graphic::VariableSection::Global, "", "[2((text := a, size := 1))]"},
      {"wide", "WSTRING(7)", graphic::VariableSection::Global, "", "\"x\"", true, true, "note"}};
  project.tasks = {{"fast", 10'000, 1}, {"rare", 0, 2, "wide"}};
  project.instances = {{"run", "chart", "fast"}, {"alone", "ladder", ""}};
  graphic::Pou chart;
  chart.name = "chart";
  chart.comment = "of a pou";
  chart.body = support::rich_chart();
  std::get<graphic::SfcChart>(chart.body).final_scan = true;
  project.pous.push_back(chart);
  graphic::Pou parallel;
  parallel.name = "parallel";
  parallel.body = support::partial_order_chart();
  project.pous.push_back(std::move(parallel));
  std::mt19937 random(5);
  graphic::Pou ladder = *lowering::lower_sfc(lowering::random_pou(random));
  ladder.name = "ladder";
  auto& rungs = std::get<graphic::LadderProgram>(ladder.body).rungs;
  rungs[0].comment = "a comment";
  rungs[0].label = "here";
  rungs[1].jump_to = "here";
  rungs[2].is_return = true;
  project.pous.push_back(std::move(ladder));
  graphic::Pou function;
  function.name = "half";
  function.kind = graphic::PouKind::Function;
  function.result_type = "LREAL";
  function.variables = {{"x", "LREAL", graphic::VariableSection::Input}};
  function.body = graphic::StBody{"half := x / 2.0;"};
  project.pous.push_back(std::move(function));
  return project;
}

TEST(PlcopenSchema, WhenEverythingIsWritten_ThenTheFileKeepsTheRules) {
  const auto xml = write_plcopen(rich_project());
  ASSERT_TRUE(xml) << result::to_string(xml.error());
  EXPECT_EQ(faults(*xml), "");
}

TEST(PlcopenSchema, WhenFilesOfEditorsAreRewritten_ThenTheyKeepTheRules) {
  for (const std::string& xml : {editor_ladder(), editor_blocks(), editor_chart()}) {
    EXPECT_EQ(faults(xml), "");
    const auto project = read_plcopen("plc.xml", xml);
    ASSERT_TRUE(project) << result::to_string(project.error());
    EXPECT_EQ(faults(*write_plcopen(*project)), "");
  }
}

TEST(PlcopenSchema, WhenChartsAndRungsAreRandom_ThenTheFilesKeepTheRules) {
  for (unsigned seed = 1; seed <= 60 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    graphic::Project project;
    project.pous.push_back(lowering::random_pou(random));
    EXPECT_EQ(faults(*write_plcopen(project)), "");
    project.pous[0] = *lowering::lower_sfc(project.pous[0]);
    EXPECT_EQ(faults(*write_plcopen(project)), "");
  }
}

// One thing that the schema requires, and is taken away.
struct Missing {
  const char* path;  // of the element that lacks it
  const char* what;  // "@name": an attribute, "name": the children of this name
};

std::string without(const std::string& xml, const Missing& missing, std::uint32_t& line) {
  pugi::xml_document document;
  document.load_string(xml.c_str(), pugi::parse_default | pugi::parse_ws_pcdata_single);
  pugi::xml_node node = document.select_node(missing.path).node();
  EXPECT_TRUE(node) << missing.path;
  if (missing.what[0] == '@') {
    EXPECT_TRUE(node.remove_attribute(missing.what + 1)) << missing.path << missing.what;
  } else {
    EXPECT_TRUE(node.child(missing.what)) << missing.path << missing.what;
    while (node.remove_child(missing.what)) {
    }
  }
  std::ostringstream out;
  document.save(out, "  ");
  const std::string text = out.str();
  // The line is that of the element's beginning.
  pugi::xml_document again;
  again.load_string(text.c_str());
  const auto offset = static_cast<std::size_t>(again.select_node(missing.path).node().offset_debug());
  line = 1 + static_cast<std::uint32_t>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
  return text;
}

class Required : public testing::TestWithParam<Missing> {};

TEST_P(Required, WhenItIsMissing_ThenTheFileIsRefusedAtItsPlace) {
  // Each is in one of them.
  const std::string first = *write_plcopen(rich_project());
  for (const std::string& xml : {first, editor_chart(), editor_blocks()}) {
    pugi::xml_document document;
    document.load_string(xml.c_str());
    if (!document.select_node(GetParam().path)) continue;
    std::uint32_t line = 0;
    const auto project = read_plcopen("plc.xml", without(xml, GetParam(), line));
    ASSERT_FALSE(project) << GetParam().path << " " << GetParam().what;
    const result::Diagnostic& found = project.error().front();
    EXPECT_EQ(found.code, "E0802");
    const bool attribute = GetParam().what[0] == '@';
    EXPECT_THAT(found.message,
                HasSubstr(attribute ? "has no attribute '" + std::string(GetParam().what + 1) + "'"
                                    : "has no child <" + std::string(GetParam().what) + ">"));
    EXPECT_EQ(found.where.line, line);
    EXPECT_FALSE(found.hint.empty());
    return;
  }
  FAIL() << GetParam().path << " is nowhere";
}

INSTANTIATE_TEST_SUITE_P(
    Rules, Required,
    testing::Values(
        Missing{"/project", "fileHeader"}, Missing{"/project", "contentHeader"}, Missing{"/project", "types"},
        Missing{"/project", "instances"}, Missing{"//fileHeader", "@companyName"},
        Missing{"//fileHeader", "@productName"}, Missing{"//fileHeader", "@productVersion"},
        Missing{"//fileHeader", "@creationDateTime"}, Missing{"//contentHeader", "@name"},
        Missing{"//contentHeader", "coordinateInfo"}, Missing{"//coordinateInfo", "ld"},
        Missing{"//coordinateInfo/sfc", "scaling"}, Missing{"//scaling", "@x"},
        Missing{"//types", "dataTypes"}, Missing{"//types", "pous"}, Missing{"//dataType", "@name"},
        Missing{"//dataType", "baseType"}, Missing{"//array", "dimension"}, Missing{"//array", "baseType"},
        Missing{"//dimension", "@upper"}, Missing{"//enum", "values"},
        Missing{"//enum/values/value", "@name"}, Missing{"//subrangeSigned", "range"},
        Missing{"//subrangeSigned", "baseType"}, Missing{"//pointer", "baseType"},
        Missing{"//derived", "@name"}, Missing{"//structValue/value", "@member"}, Missing{"//pou", "@name"},
        Missing{"//pou", "@pouType"}, Missing{"//localVars/variable", "@name"},
        Missing{"//localVars/variable", "type"}, Missing{"//actions/action", "@name"},
        Missing{"//actions/action", "body"}, Missing{"//transitions/transition", "@name"},
        Missing{"//instances", "configurations"}, Missing{"//configuration", "@name"},
        Missing{"//resource", "@name"}, Missing{"//task", "@name"}, Missing{"//task", "@priority"},
        Missing{"//pouInstance", "@name"}, Missing{"//pouInstance", "@typeName"},
        Missing{"//contact", "@localId"}, Missing{"//contact", "position"}, Missing{"//contact", "variable"},
        Missing{"//contact/position", "@y"}, Missing{"//coil", "variable"}, Missing{"//comment", "@height"},
        Missing{"//comment", "@width"}, Missing{"//comment", "content"},
        Missing{"//connection", "@refLocalId"}, Missing{"//block", "@typeName"},
        Missing{"//block", "inputVariables"}, Missing{"//block", "inOutVariables"},
        Missing{"//block", "outputVariables"}, Missing{"//block/inputVariables/variable", "@formalParameter"},
        Missing{"//block/inputVariables/variable", "connectionPointIn"},
        Missing{"//block/outputVariables/variable", "@formalParameter"},
        Missing{"//inVariable", "expression"}, Missing{"//outVariable", "expression"},
        Missing{"//inOutVariable", "expression"}, Missing{"//label", "@label"}, Missing{"//jump", "@label"},
        Missing{"//return", "position"}, Missing{"//leftPowerRail/connectionPointOut", "@formalParameter"},
        Missing{"//step", "@name"}, Missing{"//step/connectionPointOut", "@formalParameter"},
        Missing{"//step/connectionPointOutAction", "@formalParameter"}, Missing{"//jumpStep", "@targetName"},
        Missing{"//condition/inline", "@name"}, Missing{"//condition/reference", "@name"},
        Missing{"//selectionDivergence/connectionPointOut", "@formalParameter"},
        Missing{"//simultaneousDivergence/connectionPointOut", "@formalParameter"},
        Missing{"//actionBlock/action", "@localId"}, Missing{"//actionBlock/action", "relPosition"},
        Missing{"//actionBlock/action/reference", "@name"}, Missing{"//data", "@handleUnknown"}),
    [](const auto& each) {
      std::string name = std::string(each.param.path) + each.param.what;
      for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
      return name;
    });

TEST(PlcopenSchema, WhenThereIsMoreThanTheSchemaKnows_ThenItIsSeenAndTheFileIsRead) {
  const std::string xml =
      editor_project(editor_program(bools("a"),
                                    "<LD>\n<contact localId=\"1\" colour=\"red\"><position x=\"0\" "
                                    "y=\"0\"/><variable>a</variable><lamp/></contact></LD>\n"));
  EXPECT_EQ(faults(xml), "<contact> must not have the attribute 'colour'\n<contact> must not hold <lamp>\n");
  EXPECT_TRUE(read_plcopen("plc.xml", xml));
}

}  // namespace
}  // namespace stepwright::exchange

#include "ladder/exchange/plcopen_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ladder/lowering/sfc_to_ladder.h"
#include "tests/support/sample_charts.h"
#include "tests/unit/ladder/exchange/plcopen_checker.h"
#include "tests/unit/ladder/lowering/random_chart.h"

namespace stepwright::exchange {
namespace {

using graphic::SfcChart;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

graphic::Project project_of(graphic::Pou pou) {
  graphic::Project project;
  project.name = "demo";
  project.tasks = {{"fast", 10'000, 1}};
  project.instances = {{"run", pou.name, "fast"}};
  project.pous.push_back(std::move(pou));
  return project;
}

graphic::Pou pou_of(SfcChart chart) {
  graphic::Pou pou;
  pou.name = "main";
  pou.body = std::move(chart);
  return pou;
}

pugi::xml_document parsed(const result::Result<std::string>& xml) {
  pugi::xml_document document;
  EXPECT_TRUE(xml) << (xml ? "" : result::to_string(xml.error()));
  if (xml) document.load_string(xml->c_str());
  EXPECT_TRUE(document.child("project"));
  return document;
}

pugi::xml_node body_of(const pugi::xml_document& document) {
  return document.child("project").child("types").child("pous").child("pou").child("body");
}

std::string joined(const SfcChart& chart, const std::vector<graphic::StepId>& ids) {
  std::set<std::string> names;
  for (const graphic::StepId id : ids) names.insert(chart.steps[id.value].name);
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : "+") + name;
  return text;
}

std::multiset<std::string> expected_transitions(const SfcChart& chart) {
  std::multiset<std::string> result;
  for (const graphic::Transition& t : chart.transitions) {
    result.insert(joined(chart, t.sources) + " -" + t.name + "-> " + joined(chart, t.targets));
  }
  return result;
}

TEST(PlcopenWriter, WhenChartsAreRandom_ThenTheConnectionsMakeTheSameChart) {
  for (unsigned seed = 1; seed <= 300 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const graphic::Pou pou = lowering::random_pou(random);
    const pugi::xml_document document = parsed(write_plcopen(project_of(pou)));
    EXPECT_THAT(faults_of(body_of(document)), IsEmpty());
    EXPECT_EQ(transitions_of(body_of(document).child("SFC")),
              expected_transitions(std::get<SfcChart>(pou.body)));
  }
}

TEST(PlcopenWriter, WhenLaddersAreRandom_ThenEveryConnectionResolves) {
  for (unsigned seed = 1; seed <= 200 && !HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const graphic::Pou pou = *lowering::lower_sfc(lowering::random_pou(random));
    const pugi::xml_document document = parsed(write_plcopen(project_of(pou)));
    EXPECT_THAT(faults_of(body_of(document)), IsEmpty());
    const auto& rungs = std::get<graphic::LadderProgram>(pou.body).rungs;
    std::size_t coils = 0;
    for (const graphic::Rung& rung : rungs) coils += rung.coils.size();
    EXPECT_EQ(body_of(document).select_nodes("LD/coil").size(), coils);
  }
}

TEST(PlcopenWriter, WhenChartIsWritten_ThenStepsActionsAndConditionsAreThere) {
  const graphic::Project project = project_of(pou_of(support::rich_chart()));
  const pugi::xml_document document = parsed(write_plcopen(project));
  const pugi::xml_node sfc = body_of(document).child("SFC");
  EXPECT_EQ(sfc.select_nodes("step[@initialStep='true']").size(), 2U);
  EXPECT_EQ(sfc.select_nodes("jumpStep").size(), 4U);
  EXPECT_EQ(sfc.select_nodes("selectionDivergence").size(), 2U);
  EXPECT_EQ(
      sfc.select_nodes("actionBlock/action[@qualifier='SD'][@duration='T#3s']/reference[@name='q6']").size(),
      1U);
  EXPECT_EQ(sfc.select_node("transition/condition/inline[@name='GO']/ST")
                .node()
                .child("xhtml:p")
                .text()
                .as_string(),
            std::string("(a AND NOT b) OR c"));
  EXPECT_EQ(document.select_nodes("/project/types/pous/pou/actions/action[@name='COUNT']").size(), 1U);
}

TEST(PlcopenWriter, WhenProjectIsWritten_ThenHeadersTasksAndGlobalsAreInTheOrderOfTheSchema) {
  graphic::Project project = project_of(pou_of(support::sequence_chart()));
  project.globals = {{"table", "ARRAY[0..3, 1..2] OF INT", graphic::VariableSection::Global},
                     {"name", "string[20]", graphic::VariableSection::Global, "", "'x'"},
                     {"fc1", "BOOL", graphic::VariableSection::Global, "%IX0.0"},
                     {"motor", "Drive", graphic::VariableSection::Global}};
  project.globals[2].retain = true;
  const pugi::xml_document document = parsed(write_plcopen(project));
  std::string order;
  for (const pugi::xml_node child : document.child("project").children())
    order += std::string(child.name()) + " ";
  EXPECT_EQ(order, "fileHeader contentHeader types instances ");
  const pugi::xml_node configuration = document.select_node("//configuration").node();
  EXPECT_EQ(
      configuration
          .select_nodes("resource/task[@interval='T#10ms'][@priority='1']/pouInstance[@typeName='main']")
          .size(),
      1U);
  EXPECT_EQ(configuration.select_nodes("globalVars").size(), 3U);
  EXPECT_EQ(
      configuration.select_nodes("globalVars[@retain='true']/variable[@address='%IX0.0']/type/BOOL").size(),
      1U);
  EXPECT_EQ(configuration.select_nodes("//array/dimension[@lower='1'][@upper='2']").size(), 1U);
  EXPECT_EQ(configuration.select_nodes("//type/string[@length='20']").size(), 1U);
  EXPECT_EQ(configuration.select_nodes("//type/derived[@name='Drive']").size(), 1U);
  EXPECT_EQ(*write_plcopen(project), *write_plcopen(project));
}

TEST(PlcopenWriter, WhenComparisonIsInSeries_ThenItIsJoinedToThePowerByAnAnd) {
  graphic::Pou pou = pou_of({});
  graphic::Rung rung;
  rung.condition = graphic::all({graphic::any({graphic::contact("a"), graphic::contact("b")}),
                                 graphic::compare("S1", graphic::CompareOp::GreaterEqual, "3784")});
  rung.coils = {{graphic::CoilKind::Set, "q"}};
  pou.body = graphic::LadderProgram{{rung}};
  const pugi::xml_document document = parsed(write_plcopen(project_of(pou)));
  const pugi::xml_node ld = body_of(document).child("LD");
  EXPECT_EQ(ld.select_nodes("block[@typeName='GE']").size(), 1U);
  EXPECT_EQ(ld.select_nodes("block[@typeName='AND']").size(), 1U);
  EXPECT_EQ(ld.select_nodes("block[@typeName='OR']/inputVariables/variable").size(), 2U);
  EXPECT_EQ(ld.select_nodes("coil[@storage='set']").size(), 1U);
  EXPECT_EQ(ld.select_nodes("rightPowerRail/connectionPointIn").size(), 1U);
}

TEST(PlcopenWriter, WhenStatementsAreNoAssignments_ThenTheDiagnosticNamesPouAndRung) {
  SfcChart chart = support::rich_chart();
  chart.actions[0].st_body = "IF n < 5 THEN n := n + 1; END_IF";
  const graphic::Pou pou = *lowering::lower_sfc(pou_of(chart));
  const result::Result<std::string> xml = write_plcopen(project_of(pou));
  ASSERT_FALSE(xml);
  EXPECT_EQ(xml.error()[0].code, "E0814");
  EXPECT_THAT(xml.error()[0].message, HasSubstr("POU 'main', rung"));
}

TEST(PlcopenWriter, WhenChartIsUnsound_ThenItsErrorsAreReturned) {
  SfcChart chart = support::rich_chart();
  chart.transitions[0].sources.clear();
  EXPECT_FALSE(write_plcopen(project_of(pou_of(chart))));
}

}  // namespace
}  // namespace stepwright::exchange

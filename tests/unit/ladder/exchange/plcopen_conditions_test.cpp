// Conditions of transitions that are drawn: every way to negate them and to sense an edge.

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "ladder/exchange/plcopen_reader.h"
#include "ladder/exchange/plcopen_writer.h"
#include "tests/support/compiled_program.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

struct DrawnCondition {
  enum class Where { Chart, Inline, Named };
  Where where = Where::Chart;
  bool negated = false;          // the condition; a chart's own only
  bool contact_negated = false;  // contact a
  std::string contact_edge;      // "", "rising", "falling"
  bool series = false;           // with contact b behind, or beside it
  bool coil_negated = false;     // the result of a network
  std::string coil_edge;
  std::string coil_storage;
};

std::string modifiers(bool negated, const std::string& edge, const std::string& storage = "") {
  return (negated ? " negated=\"true\"" : "") + (edge.empty() ? "" : " edge=\"" + edge + "\"") +
         (storage.empty() ? "" : " storage=\"" + storage + "\"");
}

std::string connections(const std::string& from) {
  std::string text = "<connectionPointIn>";
  for (const char id : from)
    if (id != ' ') text += "<connection refLocalId=\"2" + std::string(1, id) + "\"/>";
  return text + "</connectionPointIn>";
}

std::string network_contact(char id, const std::string& from, const std::string& name,
                            const std::string& attributes) {
  return "<contact localId=\"2" + std::string(1, id) + "\"" + attributes + "><position x=\"" +
         std::to_string(40 * (id - '0')) + "\" y=\"400\"/>" + connections(from) +
         "<connectionPointOut/><variable>" + name + "</variable></contact>\n";
}

// Contacts a and b; what leaves them is in `last`.
std::string contacts(const DrawnCondition& drawn, std::string& last) {
  last = drawn.series ? "2" : "1 2";
  return "<leftPowerRail localId=\"20\"><position x=\"0\" y=\"400\"/><connectionPointOut "
         "formalParameter=\"\"/></leftPowerRail>\n" +
         network_contact('1', "0", "a", modifiers(drawn.contact_negated, drawn.contact_edge)) +
         network_contact('2', drawn.series ? "1" : "0", "b", "");
}

std::string coil(const DrawnCondition& drawn, const std::string& name) {
  std::string last;
  const std::string network = contacts(drawn, last);
  return "<LD>\n" + network + "<coil localId=\"29\"" +
         modifiers(drawn.coil_negated, drawn.coil_edge, drawn.coil_storage) +
         "><position x=\"200\" y=\"400\"/>" + connections(last) + "<connectionPointOut/><variable>" + name +
         "</variable></coil>\n</LD>\n";
}

std::string transition(const std::string& id, const std::string& from, const std::string& condition) {
  return "<transition localId=\"" + id + "\"><position x=\"0\" y=\"" + id +
         "0\"/><connectionPointIn><connection refLocalId=\"" + from +
         "\"/></connectionPointIn><connectionPointOut/>" + condition + "</transition>\n";
}

// Step Low, the condition, step High, and back at once.
std::string project_with(const DrawnCondition& drawn) {
  std::string network;
  std::string transitions;
  std::string last;
  std::string condition = drawn.negated ? "<condition negated=\"true\">" : "<condition>";
  if (drawn.where == DrawnCondition::Where::Chart) {
    network = contacts(drawn, last);
    condition += connections(last);
  } else if (drawn.where == DrawnCondition::Where::Inline) {
    condition += "<inline name=\"go\">" + coil(drawn, "go") + "</inline>";
  } else {
    condition += "<reference name=\"go\"/>";
    transitions = "<transitions><transition name=\"go\"><body>" + coil(drawn, "go") +
                  "</body></transition></transitions>\n";
  }
  const std::string chart =
      "<SFC>\n<step localId=\"1\" name=\"Low\" initialStep=\"true\"><position x=\"0\" y=\"0\"/>"
      "<connectionPointOut formalParameter=\"\"/></step>\n" +
      transition("2", "1", condition + "</condition>") +
      "<step localId=\"3\" name=\"High\"><position x=\"0\" y=\"30\"/><connectionPointIn><connection "
      "refLocalId=\"2\"/></connectionPointIn><connectionPointOut formalParameter=\"\"/>"
      "<connectionPointOutAction formalParameter=\"\"/></step>\n" +
      transition("5", "3",
                 "<condition><inline name=\"\"><ST><xhtml:p>TRUE</xhtml:p></ST></inline></condition>") +
      "<jumpStep localId=\"6\" targetName=\"Low\"><position x=\"0\" y=\"60\"/><connectionPointIn><connection "
      "refLocalId=\"5\"/></connectionPointIn></jumpStep>\n"
      "<actionBlock localId=\"4\"><position x=\"99\" y=\"30\"/><connectionPointIn><connection "
      "refLocalId=\"3\"/></connectionPointIn><action localId=\"0\" qualifier=\"N\"><relPosition x=\"0\" "
      "y=\"0\"/><reference name=\"q\"/></action></actionBlock>\n" +
      network + "</SFC>\n";
  return editor_project("<pou name=\"main\" pouType=\"program\"><interface><localVars>" + bools("a b q") +
                        "</localVars></interface>" + transitions + "<body>\n" + chart + "</body></pou>\n");
}

// What the standard says about such a chart, without our compiler.
class Reference {
 public:
  explicit Reference(const DrawnCondition& drawn) : drawn_(drawn) {}

  bool scan(bool a, bool b) {
    const bool contact = edge(drawn_.contact_edge, a, before_) != drawn_.contact_negated;
    before_ = a;
    bool power = drawn_.series ? contact && b : contact || b;
    if (drawn_.where != DrawnCondition::Where::Chart) power = output(power);
    const bool holds = power != drawn_.negated;
    // The initial step is there from the end of the first scan's tests on.
    if (first_) {
      first_ = false;
    } else {
      in_b_ = !in_b_ && holds;
    }
    return in_b_;
  }

 private:
  static bool edge(const std::string& kind, bool now, bool before) {
    return kind.empty() ? now : kind == "rising" ? now && !before : !now && before;
  }

  bool output(bool power) {
    power = power != drawn_.coil_negated;
    const bool sensed = edge(drawn_.coil_edge, power, power_before_);
    power_before_ = power;
    if (drawn_.coil_storage.empty()) return sensed;
    if (power) latch_ = drawn_.coil_storage == "set";
    return latch_;
  }

  const DrawnCondition& drawn_;
  bool before_ = false;
  bool power_before_ = false;
  bool latch_ = false;
  bool first_ = true;
  bool in_b_ = false;
};

std::string difference(const std::string& xml, const DrawnCondition& drawn) {
  const auto project = read_plcopen("plc.xml", xml);
  if (!project) return result::to_string(project.error());
  driver::CompileInput input;
  input.projects = {&*project};
  if (const auto output = driver::compile(input); !output) return result::to_string(output.error());
  support::CompiledProgram program(input);
  Reference reference(drawn);
  std::mt19937 random(7);
  for (int scan = 1; scan <= 60; ++scan) {
    const bool a = random() % 2 == 0;
    const bool b = random() % 3 == 0;
    program.set("run.a", a ? 1 : 0);
    program.set("run.b", b ? 1 : 0);
    program.scan();
    if ((program.get("run.q") != 0) != reference.scan(a, b)) return "scan " + std::to_string(scan);
  }
  const auto written = write_plcopen(*project);
  const auto copy = read_plcopen("plc.xml", *written);
  return copy && *write_plcopen(*copy) == *written ? "" : "the copy differs";
}

TEST(DrawnCondition, WhenNegatedWithAnEdgeInTheChart_ThenItHoldsAsDrawn) {
  for (int bits = 0; bits < 24; ++bits) {
    DrawnCondition drawn;
    drawn.negated = bits % 2 != 0;
    drawn.contact_negated = bits / 2 % 2 != 0;
    drawn.series = bits / 4 % 2 != 0;
    drawn.contact_edge =
        std::array<const char*, 3>{"", "rising", "falling"}[static_cast<std::size_t>(bits / 8)];
    EXPECT_EQ(difference(project_with(drawn), drawn), "") << bits;
  }
}

TEST(DrawnCondition, WhenTheResultOfANetworkIsModified_ThenItHoldsAsDrawn) {
  const std::array<const char*, 3> edges{"", "rising", "falling"};
  const std::array<const char*, 3> storages{"", "set", "reset"};
  for (std::size_t bits = 0; bits < 72; ++bits) {
    DrawnCondition drawn;
    drawn.where = bits % 2 != 0 ? DrawnCondition::Where::Named : DrawnCondition::Where::Inline;
    drawn.negated = bits / 2 % 2 != 0;
    drawn.coil_negated = bits / 4 % 2 != 0;
    drawn.contact_edge = edges[bits / 8 % 3];
    // An edge and a latch at once is nothing that can be drawn.
    if (bits < 24) drawn.coil_edge = edges[bits % 3];
    if (bits >= 24) drawn.coil_storage = storages[bits / 24];
    drawn.series = bits % 5 == 0;
    EXPECT_EQ(difference(project_with(drawn), drawn), "") << bits;
  }
}

// As a plan has it that looks at 1,500 facts before it begins: 42,000 bytes.
TEST(WrittenCondition, WhenItHasManyFacts_ThenTheFileCompiles) {
  graphic::Pou pou;
  pou.name = "main";
  std::vector<graphic::Condition> facts;
  for (int i = 0; i < 1500; ++i) {
    const std::string name = "gate_of_station" + std::to_string(1000 + i) + "_is_ready";
    pou.variables.push_back({name, "BOOL"});
    facts.push_back(graphic::contact(name));
  }
  graphic::SfcChart chart;
  chart.steps.resize(2);
  chart.steps[0].name = "START";
  chart.steps[0].initial = true;
  chart.steps[1].name = "GO";
  chart.transitions.resize(2);
  chart.transitions[0].sources = chart.transitions[1].targets = {graphic::StepId(0)};
  chart.transitions[0].targets = chart.transitions[1].sources = {graphic::StepId(1)};
  chart.transitions[0].condition = graphic::all(std::move(facts));
  chart.transitions[1].condition = graphic::always();
  pou.body = std::move(chart);
  graphic::Project project;
  project.pous = {pou};
  const auto written = write_plcopen(project);
  ASSERT_TRUE(written) << result::to_string(written.error());
  const auto read = read_plcopen("plan.xml", *written);
  ASSERT_TRUE(read) << result::to_string(read.error());
  driver::CompileInput input;
  input.projects = {&*read};
  const auto output = driver::compile(input);
  EXPECT_TRUE(output) << result::to_string(output.error());
}

}  // namespace
}  // namespace stepwright::exchange

#include "hmi_web/monitor/rung_flow.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "hmi_web/protocol/program_document.h"
#include "hmi_web/server/program_layout.h"
#include "tests/support/compiled_program.h"

namespace stepwright::monitor {
namespace {

using nlohmann::json;

// Networks whose variables are BOOLs with the values that are given; others are not known.
class Networks {
 public:
  Networks(json rungs, std::map<std::string, bool> values)
      : sheet_(read_sheet({{"blocks", std::move(rungs)}})), values_(std::move(values)) {
    for (const Block& each : sheet_.blocks) rungs_.push_back(&std::get<Rung>(each));
  }

  std::vector<RungFlow> flows() const { return flow_of(rungs_, rungs_.size(), names_); }

  // "1", "0" and "?" of every network's power; "-" of one that was passed.
  std::string powers() const {
    std::string text;
    for (const RungFlow& each : flows()) text += each.ran ? letter(each.power) : '-';
    return text;
  }

 private:
  semantics::TypeTable types_;
  Sheet sheet_;
  std::map<std::string, bool> values_;
  std::vector<const Rung*> rungs_;
  SheetValues names_{
      types_,
      [this](const std::string& path) -> Value {
        const auto found = values_.find(path);
        if (found == values_.end()) return std::nullopt;
        return Known{types_.boolean(), {found->second ? 1 : 0}};
      },
      [](const std::string& name) { return !name.starts_with("__") && !name.starts_with('>'); }};
};

json contact(const char* name, json more = json::object()) {
  more.update({{"kind", "contact"}, {"name", name}});
  return more;
}

json rung(json condition, json more = json::object()) {
  more.update({{"kind", "rung"}, {"condition", std::move(condition)}});
  return more;
}

TEST(RungFlow, WhenContactsAreOpenClosedOrUnknown_ThenPowerGoesAsFarAsItIsKnown) {
  const json either = {{"kind", "any"}, {"of", {contact("start"), contact("run")}}};
  const json latch = rung({{"kind", "all"}, {"of", {either, contact("stop", {{"negated", true}})}}});
  const auto outs = [&](std::map<std::string, bool> values) {
    const Networks networks({latch}, std::move(values));  // its types are those of the values
    const std::vector<NodeFlow> nodes = networks.flows()[0].nodes;
    return std::string{letter(nodes[1].out), letter(nodes[4].out), letter(nodes[0].out)};
  };
  EXPECT_EQ(outs({{"start", false}, {"run", true}, {"stop", false}}), "111");
  EXPECT_EQ(outs({{"start", true}, {"run", false}, {"stop", true}}), "100");
  EXPECT_EQ(outs({{"run", true}, {"stop", false}}), "111");
  EXPECT_EQ(outs({{"run", false}, {"stop", false}}), "???");
  EXPECT_EQ(outs({{"run", false}, {"stop", true}}), "?00");
}

TEST(RungFlow, WhenAnEdgeIsSensed_ThenOnlyThatItIsAwayIsKnown) {
  const auto power = [](const char* edge, bool value) {
    return Networks({rung(contact("x", {{"edge", edge}}))}, {{"x", value}}).powers();
  };
  EXPECT_EQ(power("rising", false) + power("rising", true) + power("falling", true) + power("falling", false),
            "0?0?");
}

TEST(RungFlow, WhenNetworksHandOnWiresAndLines_ThenTheNextHasThem) {
  for (const char* wire : {"__W1", ">1>"}) {
    const json coil = {{{"kind", wire[0] == '>' ? "connector" : "normal"}, {"name", wire}}};
    const json first = rung(contact("x"), {{"coils", coil}});
    EXPECT_EQ(Networks({first, rung(contact(wire, {{"negated", true}}))}, {{"x", true}}).powers(), "10")
        << wire;
  }
}

TEST(RungFlow, WhenJumpsAndReturnsAreTaken_ThenWhatTheyPassShowsItsVariablesOnly) {
  const json nothing = {{"kind", "true"}};
  const json jump = rung(contact("x"), {{"jump", "END"}});
  const json coil = {{{"kind", "normal"}, {"name", "y"}}};
  const json passed = rung(contact("y"), {{"coils", coil}});
  const json end = rung(nothing, {{"label", "End"}});
  const Networks taken({jump, passed, end}, {{"x", true}, {"y", true}});
  EXPECT_EQ(taken.powers(), "1-1");
  EXPECT_TRUE(taken.flows()[1].nodes[0].closed);
  EXPECT_TRUE(taken.flows()[1].coils[0]);
  EXPECT_EQ(Networks({jump, rung(nothing)}, {{"x", false}}).powers(), "01");
  const json back = rung(contact("x"), {{"jump", "again"}});
  EXPECT_EQ(Networks({rung(nothing, {{"label", "again"}}), back, rung(nothing)}, {{"x", true}}).powers(),
            "111");
  EXPECT_EQ(Networks({rung(contact("x"), {{"return", true}}), rung(nothing)}, {{"x", true}}).powers(), "1-");
}

TEST(RungFlow, WhenAFunctionHasPower_ThenItsResultGoesOnAsAWire) {
  const json box = json::parse(R"({"type": "GT", "inputs": [["IN1", "7"], ["IN2", "5"]],
                                   "outputs": [["OUT", "__W2"]]})");
  const json call = rung(contact("x"), {{"boxes", json::array({box})}});
  EXPECT_EQ(Networks({call, rung(contact("__W2"))}, {{"x", true}}).powers(), "11");
  EXPECT_EQ(Networks({call, rung(contact("__W2"))}, {{"x", false}}).powers(), "0?");
}

graphic::Rung network(graphic::Condition condition, const std::string& coil,
                      graphic::CoilKind kind = graphic::CoilKind::Normal) {
  graphic::Rung rung;
  rung.condition = std::move(condition);
  rung.coils.push_back({kind, coil});
  return rung;
}

// Contacts, branches, latches, comparisons, edges, jumps over a network.
graphic::Project ladder() {
  graphic::Condition risen = graphic::contact("a");
  risen.edge = graphic::Edge::Rising;
  graphic::Condition expression;
  expression.kind = graphic::ConditionKind::Expression;
  expression.name = "n MOD 3 = 0 OR d";
  graphic::LadderProgram ladder;
  ladder.rungs = {
      network(graphic::all({graphic::any({graphic::contact("a"), graphic::contact("latch")}),
                            graphic::contact("b", true)}),
              "latch"),
      network(graphic::any({graphic::all({graphic::contact("a"), graphic::contact("b")}),
                            graphic::contact("c", true)}),
              "o1"),
      network(graphic::all({graphic::contact("a"), graphic::contact("c")}), "o2", graphic::CoilKind::Negated),
      network(graphic::all({graphic::contact("b"), graphic::compare("n", graphic::CompareOp::Greater, "9")}),
              "o3"),
      network(graphic::contact("c"), "o4", graphic::CoilKind::Set),
      network(graphic::all({graphic::contact("b"), graphic::contact("d")}), "o4", graphic::CoilKind::Reset),
      network(risen, "o5"),
      network(expression, "o6")};
  graphic::Pou pou;
  pou.name = "Rungs";
  for (const char* name : {"a", "b", "c", "d", "latch", "o1", "o2", "o3", "o4", "o5", "o6", "n"}) {
    graphic::Variable variable;
    variable.name = name;
    variable.type = variable.name == "n" ? "INT" : "BOOL";
    pou.variables.push_back(std::move(variable));
  }
  pou.body = std::move(ladder);
  graphic::Project project;
  project.pous.push_back(std::move(pou));
  return project;
}

TEST(RungFlow, WhenALadderRuns_ThenWhatIsDrawnIsWhatItsCoilsAre) {
  const graphic::Project project = ladder();
  driver::CompileInput input;
  input.projects = {&project};
  input.document = true;
  support::CompiledProgram program(input);
  const auto layout = server::read_layout(program.loaded().bytes(), "d").value();
  const ProgramNames names(layout);
  const json document = protocol::parsed_document(layout.document);
  json drawn;
  for (const json& each : document["sheets"])
    if (each["name"] == "Rungs") drawn = each;
  const Sheet sheet = read_sheet(drawn);
  const Scope scope(names, sheet.sections, "Rungs");
  std::vector<const Rung*> rungs;
  for (const Block& each : sheet.blocks) rungs.push_back(&std::get<Rung>(each));
  ASSERT_EQ(rungs.size(), 8u);

  const semantics::TypeTable types;
  const Lookup nothing;
  const Evaluator evaluator(types, nothing);
  std::map<std::string, int> known;
  std::map<std::string, int> on;
  std::uint32_t seed = 7;
  constexpr int kScans = 400;
  for (int scan = 0; scan < kScans; ++scan) {
    seed = seed * 1'664'525 + 1'013'904'223;
    program.set("Rungs.a", seed >> 16 & 1);
    program.set("Rungs.b", seed >> 17 & 1);
    program.set("Rungs.c", seed >> 18 & 1);
    program.set("Rungs.d", (seed >> 19 & 3) == 1 ? 1 : 0);
    program.set("Rungs.n", (seed >> 21) % 20);
    program.scan();
    const auto image = program.image().bytes();
    const SheetValues values{types, [&](const std::string& path) { return scope.value(path, types, image); },
                             [&](const std::string& name) { return scope.declares(name); }};
    const std::vector<RungFlow> flows = flow_of(rungs, rungs.size(), values);
    for (std::size_t i = 0; i < rungs.size(); ++i) {
      const Coil& coil = rungs[i]->coils[0];
      const Value expected = driven(coil, flows[i].power, evaluator);
      const std::string name = coil.kind + ' ' + coil.operand.text;
      known[name] += expected ? 1 : 0;
      on[name] += is_true(expected) ? 1 : 0;
      // What sets may be reset by a later network.
      if (expected && coil.kind != "set") {
        EXPECT_EQ(program.get("Rungs." + coil.operand.text), is_true(expected) ? 1 : 0) << name << scan;
      }
    }
  }
  for (const char* name : {"normal latch", "normal o1", "negated o2", "normal o3", "normal o6"}) {
    EXPECT_EQ(known[name], kScans) << name;
    EXPECT_GT(on[name], 0) << name;
    EXPECT_LT(on[name], kScans) << name;
  }
  EXPECT_GT(known["normal o5"], 0) << "an edge is known to be away";
  EXPECT_LT(known["normal o5"], kScans);
  EXPECT_EQ(on["normal o5"], 0) << "and never to be there";
  EXPECT_GT(on["set o4"], 0);
  EXPECT_GT(known["reset o4"], 0);
}

}  // namespace
}  // namespace stepwright::monitor

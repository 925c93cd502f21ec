#include "hmi_web/monitor/diagram_flow.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stepwright::monitor {
namespace {

using nlohmann::json;

json pin(const char* name, unsigned from, const char* output, json more = json::object()) {
  more.update({{"name", name}, {"connections", {{{"from", from}, {"output", output}}}}});
  return more;
}

json element(const char* kind, const char* name, json inputs = json::array()) {
  return {{"kind", kind}, {"name", name}, {"inputs", std::move(inputs)}};
}

json block(const char* type, json inputs, json outputs, const char* instance = "") {
  return {{"kind", "block"},
          {"name", type},
          {"instance", instance},
          {"inputs", std::move(inputs)},
          {"outputs", std::move(outputs)}};
}

TEST(DiagramFlow, WhenBlocksAreConnected_ThenTheirWiresHaveValues) {
  const json out = {{{"name", "OUT"}}};
  const json five = {{"name", "IN2"}, {"text", "5"}};
  const json elements = {
      element("inVariable", "n"),
      block("GT", {pin("IN1", 0, ""), five}, out),
      block("AND", {pin("IN1", 1, "OUT", {{"negated", true}}), pin("IN2", 3, "Q")},
            {{{"name", "OUT"}, {"negated", true}}}),
      block("TON", {pin("IN", 2, "OUT")}, {{{"name", "Q"}}, {{"name", "ET"}}}, "t"),
      element("outVariable", "o", {pin("", 2, "OUT")}),
      block("ADD", {pin("IN1", 5, "OUT"), pin("IN2", 0, "")}, out),
      element("connector", "wire", {pin("", 1, "OUT")}),
      element("continuation", "WIRE"),
      block("ADD", {{{"name", "EN"}, {"text", "FALSE"}}, pin("IN1", 0, ""), pin("IN2", 0, "")},
            {{{"name", "ENO"}}, {{"name", "OUT"}}})};
  const Sheet sheet = read_sheet({{"blocks", {{{"kind", "diagram"}, {"elements", elements}}}}});
  const auto& diagram = std::get<Diagram>(sheet.blocks[0]);
  const semantics::TypeTable types;
  using bytecode::ElementaryType;
  const std::map<std::string, Known> known = {{"n", {types.elementary(ElementaryType::Int), {7}}},
                                              {"t.Q", {types.boolean(), {1}}},
                                              {"t.ET", {types.elementary(ElementaryType::Time), {2'000}}}};
  const Lookup lookup = [&](const std::string& path) -> Value {
    const auto found = known.find(path);
    return found == known.end() ? Value() : Value(found->second);
  };
  const Evaluator evaluator(types, lookup);
  DiagramFlow flow(diagram, evaluator, lookup);
  const auto of = [&](std::size_t index, const char* output) {
    const Value value = flow.of(index, output);
    return value ? semantics::to_string(value->constant.integer) : "open";
  };
  EXPECT_EQ(of(0, ""), "7");
  EXPECT_EQ(of(1, "OUT"), "1");
  EXPECT_EQ(of(3, "Q"), "1");
  EXPECT_EQ(of(3, "et"), "2000");
  EXPECT_EQ(of(2, "OUT"), "1") << "NOT (NOT TRUE AND Q)";
  EXPECT_EQ(of(4, ""), "1");
  EXPECT_EQ(of(5, "OUT"), "open") << "what leads back to itself";
  EXPECT_EQ(of(7, ""), "1") << "a continuation has what its connector has";
  EXPECT_EQ(of(8, "ENO"), "0");
  EXPECT_EQ(of(8, "OUT"), "open") << "a function that does not run";
  EXPECT_EQ(of(99, ""), "open");
}

}  // namespace
}  // namespace stepwright::monitor

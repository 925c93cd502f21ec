#include "ladder/print/body_json.h"

#include <algorithm>
#include <string>
#include <utility>

#include "ladder/graphic/sfc_layout.h"
#include "ladder/print/body_uses.h"
#include "ladder/print/diagram_json.h"

namespace stepwright::print {

namespace {

using graphic::Condition;
using graphic::ConditionKind;
using nlohmann::ordered_json;

void put(ordered_json& json, const char* key, const std::string& text) {
  if (!text.empty()) json[key] = text;
}

// Lines of a text as it is, so that columns count in it.
ordered_json lines_json(const std::string& text) {
  ordered_json lines = ordered_json::array();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    while (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(std::move(line));
    begin = end + 1;
  }
  return lines;
}

ordered_json condition_json(const Condition& condition) {
  ordered_json children = ordered_json::array();
  for (const Condition& each : condition.children) children.push_back(condition_json(each));
  switch (condition.kind) {
    case ConditionKind::True:
      break;
    case ConditionKind::Contact: {
      ordered_json json = {{"kind", "contact"}, {"name", condition.name}};
      if (condition.negated) json["negated"] = true;
      if (condition.edge != graphic::Edge::None)
        json["edge"] = condition.edge == graphic::Edge::Rising ? "rising" : "falling";
      return json;
    }
    case ConditionKind::Comparison:
      return {{"kind", "test"},
              {"text", condition.name + " " + to_st(condition.op) + " " + condition.operand}};
    case ConditionKind::Expression: {
      ordered_json json = {{"kind", "test"}, {"text", condition.name}};
      if (condition.negated) json["negated"] = true;
      return json;
    }
    case ConditionKind::All:
      return {{"kind", "all"}, {"of", std::move(children)}};
    case ConditionKind::Any:
      return {{"kind", "any"}, {"of", std::move(children)}};
  }
  return {{"kind", "true"}};
}

const char* word_of(const graphic::Coil& coil) {
  if (graphic::is_connector(coil.variable)) return "connector";
  switch (coil.kind) {
    case graphic::CoilKind::Normal:
      break;
    case graphic::CoilKind::Negated:
      return "negated";
    case graphic::CoilKind::Set:
      return "set";
    case graphic::CoilKind::Reset:
      return "reset";
    case graphic::CoilKind::RisingEdge:
      return "rising";
    case graphic::CoilKind::FallingEdge:
      return "falling";
  }
  return "normal";
}

ordered_json pins_json(const std::vector<std::pair<std::string, std::string>>& pins) {
  ordered_json list = ordered_json::array();
  for (const auto& [pin, value] : pins) list.push_back({pin, value});
  return list;
}

ordered_json block_json(const graphic::Block& block) {
  ordered_json json = ordered_json::object();
  put(json, "type", block.type);
  put(json, "instance", block.instance);
  put(json, "power", block.power_input);
  put(json, "text", block.st_body);
  json["inputs"] = pins_json(block.inputs);
  json["outputs"] = pins_json(block.outputs);
  return json;
}

ordered_json rung_json(const graphic::Rung& rung, std::uint32_t number) {
  ordered_json json = {{"kind", "rung"}, {"number", number}};
  put(json, "label", rung.label);
  put(json, "comment", rung.comment);
  if (rung.goes_on) json["goes_on"] = true;
  json["condition"] = condition_json(rung.condition);
  json["boxes"] = ordered_json::array();
  for (const graphic::Block& each : rung.blocks) json["boxes"].push_back(block_json(each));
  json["coils"] = ordered_json::array();
  for (const graphic::Coil& each : rung.coils)
    json["coils"].push_back({{"kind", word_of(each)}, {"name", each.variable}});
  put(json, "jump", rung.jump_to);
  if (rung.is_return) json["return"] = true;
  return json;
}

ordered_json step_json(const graphic::Step& step) {
  ordered_json json = {{"kind", "step"}, {"name", step.name}};
  if (step.initial) json["initial"] = true;
  put(json, "comment", step.comment);
  json["actions"] = ordered_json::array();
  for (const graphic::ActionBlock& each : step.actions) {
    ordered_json action = {{"qualifier", to_string(each.qualifier)}, {"target", each.target}};
    put(action, "duration", each.duration);
    put(action, "indicator", each.indicator);
    json["actions"].push_back(std::move(action));
  }
  return json;
}

ordered_json ids_json(const std::vector<graphic::StepId>& steps) {
  ordered_json list = ordered_json::array();
  for (const graphic::StepId each : steps) list.push_back(each.value);
  return list;
}

struct Blocks {
  ordered_json operator()(const graphic::Listing& listing) const {
    if (listing.lines.empty()) return ordered_json::array();
    return {{{"kind", "text"}, {"first", listing.first_line}, {"lines", listing.lines}}};
  }

  ordered_json operator()(const graphic::LadderProgram& program) const {
    const std::vector<std::uint32_t> numbers = network_numbers(program);
    ordered_json list = ordered_json::array();
    for (std::size_t i = 0; i < program.rungs.size(); ++i)
      list.push_back(rung_json(program.rungs[i], numbers[i]));
    return list;
  }

  ordered_json operator()(const graphic::SfcChart& chart) const {
    ordered_json list = ordered_json::array();
    for (const graphic::Step& each : chart.steps) list.push_back(step_json(each));
    for (std::size_t i = 0; i < chart.transitions.size(); ++i) {
      const graphic::Transition& each = chart.transitions[i];
      ordered_json json = {{"kind", "transition"},
                           {"name", graphic::drawn_label(chart, i)},
                           {"from", ids_json(each.sources)},
                           {"to", ids_json(each.targets)},
                           {"lines", lines_json(condition_text(each.condition))}};
      list.push_back(std::move(json));
    }
    for (const graphic::Action& each : chart.actions)
      list.push_back({{"kind", "action"}, {"name", each.name}, {"lines", lines_json(each.st_body)}});
    return list;
  }
};

}  // namespace

const char* language_of(const graphic::Sheet& sheet) {
  if (sheet.drawn) return "FBD";
  if (std::holds_alternative<graphic::LadderProgram>(sheet.body)) return "LD";
  return std::holds_alternative<graphic::SfcChart>(sheet.body) ? "SFC" : "ST";
}

ordered_json blocks_json(const graphic::Sheet& sheet) {
  if (sheet.drawn) return ordered_json::array({diagram_json(*sheet.drawn)});
  return std::visit(Blocks{}, sheet.body);
}

}  // namespace stepwright::print

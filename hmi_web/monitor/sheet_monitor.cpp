#include "hmi_web/monitor/sheet_monitor.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hmi_web/monitor/diagram_flow.h"
#include "hmi_web/protocol/json_text.h"

namespace stepwright::monitor {
namespace {

using nlohmann::json;

json rung_json(const RungFlow& flow) {
  std::string nodes;
  std::string coils;
  for (const NodeFlow& each : flow.nodes)
    nodes += {letter(each.in), letter(each.out), each.closed ? '1' : '0'};
  for (const bool each : flow.coils) coils += each ? '1' : '0';
  return {
      {"ran", flow.ran}, {"power", std::string(1, letter(flow.power))}, {"nodes", nodes}, {"coils", coils}};
}

json body_json(const BodyPlaces& places, const Texts& texts, const Evaluator& evaluator) {
  json tested = json::array();
  json indexed = json::array();
  for (const auto& [where, condition] : places.conditions)
    if (const Value value = evaluator.value(*condition); is_bool(value))
      tested.push_back({texts.place(where).line, is_true(value)});
  for (const auto& [where, variable] : places.indexed) {
    const auto path = evaluator.path(*variable);
    if (!path) continue;
    const source::LineColumn place = texts.place(where);
    indexed.push_back({place.line, place.column, *path});
  }
  return {{"tested", std::move(tested)}, {"indexed", std::move(indexed)}};
}

// With its type, as a page writes it; null if it is not known.
json value_json(const Value& value) {
  if (!value) return nullptr;
  const semantics::Type& type = *value->type;
  if (type.is_date()) return nullptr;  // a text, to people
  const double number = type.is_real() ? value->constant.real : static_cast<double>(value->constant.integer);
  if (type.is_time()) return {number / 1e9, bytecode::name_of(type.elementary)};  // in seconds
  const bool is_real = !type.is_literal() && type.elementary == bytecode::ElementaryType::Real;
  return {protocol::value_json(number, is_real), type.is_real() && type.is_literal() ? "REAL"
                                                 : type.is_literal()                 ? "DINT"
                                                                     : bytecode::name_of(type.elementary)};
}

json diagram_json(const Diagram& diagram, const Evaluator& evaluator, const Lookup& lookup) {
  DiagramFlow flow(diagram, evaluator, lookup);
  json wires = json::object();
  const auto add = [&](std::size_t element, const std::string& output) {
    const std::string key = std::to_string(element) + ' ' + folded(output);
    if (!wires.contains(key)) wires[key] = value_json(flow.of(element, output));
  };
  for (std::size_t i = 0; i < diagram.elements.size(); ++i) {
    for (const Pin& pin : diagram.elements[i].outputs) add(i, pin.name);
    for (const Pin& pin : diagram.elements[i].inputs)
      for (const auto& [from, output] : pin.connections) add(from, output);
  }
  return {{"wires", std::move(wires)}};
}

}  // namespace

SheetMonitor::SheetMonitor(const ProgramNames& names, Sheet sheet, std::string instance)
    : sheet_(std::move(sheet)), scope_(names, sheet_.sections, std::move(instance)) {
  rung_of_.resize(sheet_.blocks.size());
  bodies_.resize(sheet_.blocks.size());
  for (std::size_t i = 0; i < sheet_.blocks.size(); ++i) {
    if (const auto* body = std::get_if<Body>(&sheet_.blocks[i])) bodies_[i] = places_of(*body);
    const auto* rung = std::get_if<Rung>(&sheet_.blocks[i]);
    if (rung == nullptr) continue;
    rung_of_[i] = rungs_.size();
    rungs_.push_back(rung);
  }
}

json SheetMonitor::look(const semantics::TypeTable& types, std::span<const std::byte> image,
                        const std::vector<protocol::TagRange>& blocks) const {
  const SheetValues values{types, [&](const std::string& path) { return scope_.value(path, types, image); },
                           [&](const std::string& name) { return scope_.declares(name); }};
  const Evaluator evaluator(types, values.lookup);
  std::vector<std::size_t> asked;
  std::size_t networks = 0;  // up to the last one that is asked for: each hands on what it has
  for (const protocol::TagRange& range : blocks) {
    const std::size_t end =
        std::min<std::size_t>(sheet_.blocks.size(), std::size_t{range.first} + range.count);
    for (std::size_t i = range.first; i < end; ++i) {
      asked.push_back(i);
      if (std::holds_alternative<Rung>(sheet_.blocks[i])) networks = std::max(networks, rung_of_[i] + 1);
    }
  }
  const std::vector<RungFlow> flows = flow_of(rungs_, networks, values);
  json result = json::object();
  for (const std::size_t i : asked) {
    const std::string key = std::to_string(i);
    if (std::holds_alternative<Rung>(sheet_.blocks[i])) {
      result[key] = rung_json(flows[rung_of_[i]]);
    } else if (const auto* diagram = std::get_if<Diagram>(&sheet_.blocks[i])) {
      result[key] = diagram_json(*diagram, evaluator, values.lookup);
    } else if (std::holds_alternative<Body>(sheet_.blocks[i])) {
      result[key] = body_json(bodies_[i], *sheet_.texts, evaluator);
    }
  }
  return result;
}

}  // namespace stepwright::monitor

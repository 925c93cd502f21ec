#include "ladder/print/diagram_json.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace stepwright::print {

namespace {

using nlohmann::ordered_json;

class Writer {
 public:
  explicit Writer(const graphic::Diagram& diagram) : diagram_(diagram) {
    for (const graphic::Element& each : diagram.elements) index_.try_emplace(each.id, index_.size());
  }

  ordered_json run() const {
    ordered_json elements = ordered_json::array();
    for (const graphic::Element& each : diagram_.elements) elements.push_back(element(each));
    return {{"kind", "diagram"}, {"elements", std::move(elements)}};
  }

 private:
  static void put(const graphic::Modifier& modifier, ordered_json& json) {
    if (modifier.negated) json["negated"] = true;
    if (modifier.edge != graphic::Edge::None)
      json["edge"] = modifier.edge == graphic::Edge::Rising ? "rising" : "falling";
    if (modifier.storage != graphic::Storage::None)
      json["storage"] = modifier.storage == graphic::Storage::Set ? "set" : "reset";
  }

  // What leads to an element that is not there is left out.
  ordered_json connections(const graphic::Pin& pin) const {
    ordered_json list = ordered_json::array();
    for (const graphic::Connection& each : pin.connections) {
      const auto from = index_.find(each.from);
      if (from == index_.end()) continue;
      ordered_json path = ordered_json::array();
      for (const graphic::Place& point : each.path) path.push_back({point.x, point.y});
      list.push_back({{"from", from->second}, {"output", each.output}, {"path", std::move(path)}});
    }
    return list;
  }

  ordered_json pins(const std::vector<graphic::Pin>& pins) const {
    ordered_json list = ordered_json::array();
    for (const graphic::Pin& each : pins) {
      ordered_json json = {{"name", each.name}};
      put(each.modifier, json);
      if (!each.expression.text.empty()) json["text"] = each.expression.text;
      if (each.position) json["at"] = {each.position->x, each.position->y};
      if (!each.connections.empty()) json["connections"] = connections(each);
      list.push_back(std::move(json));
    }
    return list;
  }

  ordered_json element(const graphic::Element& element) const {
    ordered_json json = {{"kind", to_string(element.kind)}, {"at", {element.position.x, element.position.y}}};
    if (element.width && element.height) json["size"] = {*element.width, *element.height};
    if (!element.name.text.empty()) json["name"] = element.name.text;
    if (!element.instance.empty()) json["instance"] = element.instance;
    put(element.modifier, json);
    if (!element.inputs.empty()) json["inputs"] = pins(element.inputs);
    if (!element.in_outs.empty()) json["in_outs"] = pins(element.in_outs);
    if (!element.outputs.empty()) json["outputs"] = pins(element.outputs);
    return json;
  }

  const graphic::Diagram& diagram_;
  std::map<std::uint64_t, std::size_t> index_;  // of elements by their identifiers
};

}  // namespace

ordered_json diagram_json(const graphic::Diagram& diagram) {
  return Writer(diagram).run();
}

}  // namespace stepwright::print

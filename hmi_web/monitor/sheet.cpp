#include "hmi_web/monitor/sheet.h"

#include <nlohmann/json.hpp>

#include "ladder/graphic/ladder_program.h"

namespace stepwright::monitor {
namespace {

using nlohmann::json;

const json& member(const json& object, const char* name) {
  static const json nothing;
  if (!object.is_object()) return nothing;
  const auto found = object.find(name);
  return found == object.end() ? nothing : *found;
}

std::string text_of(const json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::string text_of(const json& object, const char* name) {
  return text_of(member(object, name));
}

bool flag_of(const json& object, const char* name) {
  return member(object, name) == true;
}

// Empty if it is none.
const json& list_of(const json& object, const char* name) {
  static const json none = json::array();
  const json& list = member(object, name);
  return list.is_array() ? list : none;
}

std::string lines_of(const json& block) {
  std::string text;
  for (const json& line : list_of(block, "lines")) text += text_of(line) + '\n';
  return text;
}

class Reader {
 public:
  explicit Reader(Texts& texts) : texts_(texts) {}

  Block block(const json& block) {
    const std::string kind = text_of(block, "kind");
    if (kind == "rung") return rung(block);
    if (kind == "text" || kind == "action") return Body{&texts_.statements(lines_of(block)), nullptr};
    if (kind == "transition") return Body{nullptr, texts_.expression(lines_of(block))};
    if (kind == "diagram") return diagram(block);
    return {};
  }

 private:
  Operand operand(std::string text) {
    const bool is_text = !text.empty() && !graphic::is_connector(text);
    const syntax::Expression* expression = is_text ? texts_.expression(text) : nullptr;
    return {std::move(text), expression};
  }

  Node node(const json& condition) {
    Node node;
    const std::string kind = text_of(condition, "kind");
    if (kind == "true") return node;
    if (kind == "all" || kind == "any") {
      node.kind = kind == "all" ? NodeKind::All : NodeKind::Any;
      for (const json& each : list_of(condition, "of")) node.of.push_back(this->node(each));
      return node;
    }
    const bool contact = kind == "contact";
    node.kind = contact ? NodeKind::Contact : NodeKind::Test;
    node.operand = operand(text_of(condition, contact ? "name" : "text"));
    node.negated = flag_of(condition, "negated");
    const std::string edge = contact ? text_of(condition, "edge") : "";
    node.edge = edge == "rising" ? EdgeKind::Rising : edge == "falling" ? EdgeKind::Falling : EdgeKind::None;
    return node;
  }

  Box box(const json& value) {
    Box box{text_of(value, "type"), text_of(value, "instance"), {}, {}};
    for (const json& pair : list_of(value, "inputs"))
      if (pair.is_array() && pair.size() > 1) box.inputs.push_back(operand(text_of(pair[1])));
    for (const json& pair : list_of(value, "outputs"))
      if (pair.is_array() && pair.size() > 1) box.outputs.emplace_back(text_of(pair[0]), text_of(pair[1]));
    return box;
  }

  Rung rung(const json& value) {
    Rung rung;
    rung.label = folded(text_of(value, "label"));
    rung.condition = node(member(value, "condition"));
    for (const json& each : list_of(value, "boxes")) rung.boxes.push_back(box(each));
    for (const json& each : list_of(value, "coils"))
      rung.coils.push_back({text_of(each, "kind"), operand(text_of(each, "name"))});
    rung.jump = folded(text_of(value, "jump"));
    rung.returns = flag_of(value, "return");
    return rung;
  }

  Pin pin(const json& value) {
    Pin pin;
    pin.name = text_of(value, "name");
    pin.negated = flag_of(value, "negated");
    pin.edge = !text_of(value, "edge").empty();
    pin.text = operand(text_of(value, "text"));
    pin.has_text = !pin.text.text.empty();
    for (const json& each : list_of(value, "connections")) {
      const json& from = member(each, "from");
      if (from.is_number_unsigned())
        pin.connections.emplace_back(from.get<std::size_t>(), text_of(each, "output"));
    }
    return pin;
  }

  Diagram diagram(const json& value) {
    Diagram diagram;
    for (const json& each : list_of(value, "elements")) {
      Element element;
      element.kind = text_of(each, "kind");
      element.instance = text_of(each, "instance");
      element.negated = flag_of(each, "negated");
      element.edge = !text_of(each, "edge").empty();
      const bool is_value =
          element.kind == "inVariable" || element.kind == "inOutVariable" || element.kind == "contact";
      element.name = is_value ? operand(text_of(each, "name")) : Operand{text_of(each, "name"), nullptr};
      for (const char* side : {"inputs", "in_outs"})
        for (const json& one : list_of(each, side)) element.inputs.push_back(pin(one));
      for (const json& one : list_of(each, "outputs")) element.outputs.push_back(pin(one));
      diagram.elements.push_back(std::move(element));
    }
    return diagram;
  }

  Texts& texts_;
};

}  // namespace

Sheet read_sheet(const json& value) {
  Sheet sheet;
  sheet.texts = std::make_unique<Texts>();
  for (const json& each : list_of(value, "variables"))
    sheet.sections.insert_or_assign(folded(text_of(each, "name")), text_of(each, "section"));
  Reader reader(*sheet.texts);
  for (const json& each : list_of(value, "blocks")) sheet.blocks.push_back(reader.block(each));
  return sheet;
}

}  // namespace stepwright::monitor

// Bodies of PLCopen TC6 XML as they are drawn.

#include <array>
#include <cstdio>
#include <pugixml.hpp>

#include "ladder/exchange/plcopen_parts.h"
#include "ladder/exchange/xml_file.h"

namespace stepwright::exchange::plcopen {
namespace {

using graphic::Element;
using graphic::ElementKind;
using graphic::Modifier;
using graphic::Pin;

// The shortest text that reads back as the same number.
std::string decimal(double value) {
  std::array<char, 40> buffer{};
  for (int digits = 1; digits <= 17; ++digits) {
    std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
    if (std::strtod(buffer.data(), nullptr) == value) break;
  }
  const std::string text = buffer.data();
  if (text.find('e') == std::string::npos) return text;
  std::snprintf(buffer.data(), buffer.size(), "%.6f", value);  // xsd:decimal knows no exponent
  return buffer.data();
}

void add_place(pugi::xml_node parent, const char* name, const graphic::Place& place) {
  pugi::xml_node node = parent.append_child(name);
  node.append_attribute("x") = decimal(place.x).c_str();
  node.append_attribute("y") = decimal(place.y).c_str();
}

void add_modifier(pugi::xml_node node, const Modifier& modifier, const std::string& suffix = "") {
  if (modifier.negated) node.append_attribute(("negated" + suffix).c_str()) = true;
  if (modifier.edge != graphic::Edge::None)
    node.append_attribute(("edge" + suffix).c_str()) =
        modifier.edge == graphic::Edge::Rising ? "rising" : "falling";
  if (modifier.storage != graphic::Storage::None)
    node.append_attribute(("storage" + suffix).c_str()) =
        modifier.storage == graphic::Storage::Set ? "set" : "reset";
}

void add_documentation(pugi::xml_node node, const std::string& text) {
  if (!text.empty()) add_text(node, "documentation", text);
}

void add_expression(pugi::xml_node parent, const graphic::SourceText& text) {
  if (!text.text.empty()) parent.append_child("expression").text() = text.text.c_str();
}

void add_in(pugi::xml_node parent, const Pin& pin) {
  pugi::xml_node point = parent.append_child("connectionPointIn");
  append_attributes(point, pin.point_extra);
  if (pin.position) add_place(point, "relPosition", *pin.position);
  for (const graphic::Connection& each : pin.connections) {
    pugi::xml_node connection = point.append_child("connection");
    connection.append_attribute("refLocalId") = each.from;
    if (!each.output.empty()) connection.append_attribute("formalParameter") = each.output.c_str();
    append_attributes(connection, each.extra);
    for (const graphic::Place& place : each.path) add_place(connection, "position", place);
    append_children(connection, each.extra);
  }
  add_expression(point, pin.expression);
  append_children(point, pin.point_extra);
}

// `named`: the schema wants the attribute also where it is empty.
void add_out(pugi::xml_node parent, const char* element, const Pin& pin, bool named) {
  pugi::xml_node point = parent.append_child(element);
  if (named) point.append_attribute("formalParameter") = pin.name.c_str();
  append_attributes(point, pin.point_extra);
  if (pin.position) add_place(point, "relPosition", *pin.position);
  add_expression(point, pin.expression);
  append_children(point, pin.point_extra);
}

void add_variables(pugi::xml_node block, const char* element, const std::vector<Pin>& pins, bool input) {
  pugi::xml_node list = block.append_child(element);
  for (const Pin& pin : pins) {
    pugi::xml_node node = list.append_child("variable");
    node.append_attribute("formalParameter") = pin.name.c_str();
    add_modifier(node, pin.modifier);
    append_attributes(node, pin.extra);
    if (input && pin.has_point) add_in(node, pin);
    if (!input && pin.has_point) {
      pugi::xml_node point = node.append_child("connectionPointOut");
      append_attributes(point, pin.point_extra);
      if (pin.position) add_place(point, "relPosition", *pin.position);
      add_expression(point, pin.expression);
      append_children(point, pin.point_extra);
    }
    append_children(node, pin.extra);
    add_documentation(node, pin.documentation);
  }
}

bool outputs_are_named(ElementKind kind) {
  return kind == ElementKind::LeftPowerRail || kind == ElementKind::Step ||
         kind == ElementKind::SelectionDivergence || kind == ElementKind::SimultaneousDivergence;
}

const char* name_attribute(ElementKind kind) {
  switch (kind) {
    case ElementKind::Block:
      return "typeName";
    case ElementKind::Label:
    case ElementKind::Jump:
      return "label";
    case ElementKind::JumpStep:
      return "targetName";
    case ElementKind::Connector:
    case ElementKind::Continuation:
    case ElementKind::Step:
    case ElementKind::SimultaneousDivergence:
      return "name";
    default:
      return nullptr;
  }
}

void add_condition(pugi::xml_node node, const graphic::TransitionCondition& condition) {
  if (condition.source == graphic::ConditionSource::None) return;
  pugi::xml_node child = node.append_child("condition");
  if (condition.negated) child.append_attribute("negated") = true;
  if (condition.source == graphic::ConditionSource::Reference)
    child.append_child("reference").append_attribute("name") = condition.reference.c_str();
  if (condition.source == graphic::ConditionSource::Connection) add_in(child, condition.input);
  if (condition.source != graphic::ConditionSource::Inline) return;
  pugi::xml_node inlined = child.append_child("inline");
  inlined.append_attribute("name") = condition.reference.c_str();
  write_body(inlined, condition.body.front());
}

void add_action(pugi::xml_node block, const graphic::DiagramAction& action, std::size_t number) {
  pugi::xml_node node = block.append_child("action");
  append_attributes(node, action.extra);
  if (!node.attribute("localId")) node.append_attribute("localId") = number;
  if (!action.qualifier.empty()) node.append_attribute("qualifier") = action.qualifier.c_str();
  if (!action.duration.empty()) node.append_attribute("duration") = action.duration.c_str();
  if (!action.indicator.empty()) node.append_attribute("indicator") = action.indicator.c_str();
  add_place(node, "relPosition", action.position.value_or(graphic::Place{}));
  if (!action.reference.empty())
    node.append_child("reference").append_attribute("name") = action.reference.c_str();
  if (!action.body.empty()) write_body(node.append_child("inline"), action.body.front());
  append_children(node, action.extra);
  add_documentation(node, action.documentation);
}

void add_attributes(pugi::xml_node node, const Element& element) {
  node.append_attribute("localId") = element.id;
  if (element.width) node.append_attribute("width") = decimal(*element.width).c_str();
  if (element.height) node.append_attribute("height") = decimal(*element.height).c_str();
  if (element.order) node.append_attribute("executionOrderId") = *element.order;
  const char* name = name_attribute(element.kind);
  if (name != nullptr && (!element.name.text.empty() || element.kind != ElementKind::SimultaneousDivergence))
    node.append_attribute(name) = element.name.text.c_str();
  if (!element.instance.empty()) node.append_attribute("instanceName") = element.instance.c_str();
  if (element.initial) node.append_attribute("initialStep") = true;
  if (element.priority) node.append_attribute("priority") = *element.priority;
  if (element.kind == ElementKind::InOutVariable) {
    add_modifier(node, element.modifier, "In");
    add_modifier(node, element.output_modifier, "Out");
  } else {
    add_modifier(node, element.modifier);
  }
  append_attributes(node, element.extra);
}

void add_element(pugi::xml_node body, const Element& element) {
  const ElementKind kind = element.kind;
  pugi::xml_node node = body.append_child(graphic::to_string(kind));
  add_attributes(node, element);
  add_place(node, "position", element.position);
  if (kind == ElementKind::Comment || kind == ElementKind::Error)
    add_text(node, "content", element.name.text);
  if (kind == ElementKind::VendorElement) add_text(node, "alternativeText", element.name.text);
  if (kind == ElementKind::Block || kind == ElementKind::VendorElement) {
    add_variables(node, "inputVariables", element.inputs, true);
    add_variables(node, "inOutVariables", element.in_outs, true);
    add_variables(node, "outputVariables", element.outputs, false);
  } else {
    for (const Pin& pin : element.inputs) add_in(node, pin);
    for (const Pin& pin : element.outputs) add_out(node, "connectionPointOut", pin, outputs_are_named(kind));
  }
  if (element.action_output) add_out(node, "connectionPointOutAction", *element.action_output, true);
  if (kind == ElementKind::Transition) add_condition(node, element.condition);
  for (std::size_t i = 0; i < element.actions.size(); ++i) add_action(node, element.actions[i], i);
  if (kind == ElementKind::Contact || kind == ElementKind::Coil)
    node.append_child("variable").text() = element.name.text.c_str();
  if (kind == ElementKind::InVariable || kind == ElementKind::OutVariable ||
      kind == ElementKind::InOutVariable)
    node.append_child("expression").text() = element.name.text.c_str();
  append_children(node, element.extra);
  add_documentation(node, element.documentation);
}

}  // namespace

void write_body(pugi::xml_node node, const graphic::DiagramBody& body) {
  append_attributes(node, body.extra);
  if (body.language == graphic::BodyLanguage::StructuredText) add_text(node, "ST", body.text.text);
  if (body.language == graphic::BodyLanguage::InstructionList) add_text(node, "IL", body.text.text);
  if (body.language == graphic::BodyLanguage::Diagram) {
    constexpr std::array<const char*, 3> names{"LD", "FBD", "SFC"};
    pugi::xml_node diagram = node.append_child(names[static_cast<std::size_t>(body.diagram.language)]);
    for (const Element& element : body.diagram.elements) add_element(diagram, element);
  }
  append_children(node, body.extra);
  add_documentation(node, body.documentation);
}

// TC6 has no word for action control with final scan.
void add_final_scan(pugi::xml_node body) {
  pugi::xml_node all = body.child("addData");
  if (!all) {
    all = body.child("documentation") ? body.insert_child_before("addData", body.child("documentation"))
                                      : body.append_child("addData");
  }
  for (const pugi::xml_node data : all.children("data"))
    if (data.attribute("name").value() == std::string_view(kChartData)) return;
  pugi::xml_node data = all.append_child("data");
  data.append_attribute("name") = kChartData;
  data.append_attribute("handleUnknown") = "preserve";
  pugi::xml_node chart = data.append_child("chart");
  chart.append_attribute("xmlns") = kChartData;
  chart.append_attribute("finalScan") = true;
}

void write_drawn(pugi::xml_node pou, const graphic::DrawnBody& drawn) {
  const auto list = [&](const char* name, const char* element,
                        const std::vector<graphic::NamedBody>& bodies) {
    if (bodies.empty()) return;
    pugi::xml_node parent = pou.append_child(name);
    for (const graphic::NamedBody& each : bodies) {
      pugi::xml_node node = parent.append_child(element);
      node.append_attribute("name") = each.name.c_str();
      append_attributes(node, each.extra);
      write_body(node.append_child("body"), each.body);
      append_children(node, each.extra);
      add_documentation(node, each.documentation);
    }
  };
  list("actions", "action", drawn.actions);
  list("transitions", "transition", drawn.transitions);
  pugi::xml_node body = pou.append_child("body");
  write_body(body, drawn.body);
  if (drawn.final_scan) add_final_scan(body);
}

}  // namespace stepwright::exchange::plcopen

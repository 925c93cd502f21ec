// Bodies of PLCopen TC6 XML as they are drawn.

#include <array>

#include "ladder/exchange/plcopen_read.h"

namespace stepwright::exchange::plcopen {
namespace {

namespace code = source::code;
using graphic::Element;
using graphic::ElementKind;
using graphic::Extra;
using graphic::Pin;

class DiagramReader {
 public:
  DiagramReader(ReadContext& context, graphic::Diagram& diagram) : context_(context), diagram_(diagram) {}

  void read(pugi::xml_node body) {
    for (const pugi::xml_node node : body.children())
      if (node.type() == pugi::node_element) element(node);
  }

 private:
  static std::optional<ElementKind> kind_of(std::string_view name) {
    for (int i = 0; i <= static_cast<int>(ElementKind::SimultaneousConvergence); ++i) {
      const auto kind = static_cast<ElementKind>(i);
      if (name == graphic::to_string(kind)) return kind;
    }
    return std::nullopt;
  }

  void element(pugi::xml_node node) {
    const std::optional<ElementKind> kind = kind_of(local_name(node));
    if (!kind) {
      context_.error(node, code::kNotPlcopen,
                     "<" + std::string(local_name(node)) + "> is no element of a diagram",
                     "TC6 has vendorElement and addData for what is a vendor's own");
      return;
    }
    Element element;
    element.kind = *kind;
    element.where = context_.file().offset(node);
    element.id = context_.number(node, "localId").value_or(0);
    element.width = context_.decimal(node, "width");
    element.height = context_.decimal(node, "height");
    element.order = context_.number(node, "executionOrderId");
    if (const pugi::xml_node position = child(node, "position"))
      element.position = place(position).value_or(graphic::Place{});
    pins(node, element);
    own(node, element);
    element.documentation = context_.documentation(node);
    element.extra = extra_of(
        node,
        {"localId",   "width",      "height",    "executionOrderId", "negated",     "edge",       "storage",
         "negatedIn", "edgeIn",     "storageIn", "negatedOut",       "edgeOut",     "storageOut", "name",
         "label",     "targetName", "typeName",  "instanceName",     "initialStep", "priority"},
        {"position", "connectionPointIn", "connectionPointOut", "connectionPointOutAction", "inputVariables",
         "inOutVariables", "outputVariables", "variable", "expression", "content", "alternativeText",
         "condition", "action", "documentation", element.kind == ElementKind::MacroStep ? "" : "body"});
    if (element.kind == ElementKind::MacroStep) {
      // Its name and body stay with what is not read; lowering refuses it.
      element.extra.children =
          extra_of(node, {}, {"position", "connectionPointIn", "connectionPointOut", "documentation"})
              .children;
    }
    diagram_.elements.push_back(std::move(element));
  }

  std::optional<graphic::Place> place(pugi::xml_node node) {
    if (!node) return std::nullopt;
    return graphic::Place{context_.decimal(node, "x").value_or(0), context_.decimal(node, "y").value_or(0)};
  }

  graphic::Modifier modifier(pugi::xml_node node, const std::string& suffix = "") {
    graphic::Modifier modifier;
    modifier.negated = context_.boolean(node, ("negated" + suffix).c_str());
    const std::string edge = node.attribute(("edge" + suffix).c_str()).value();
    if (edge == "rising") modifier.edge = graphic::Edge::Rising;
    if (edge == "falling") modifier.edge = graphic::Edge::Falling;
    const std::string storage = node.attribute(("storage" + suffix).c_str()).value();
    if (storage == "set") modifier.storage = graphic::Storage::Set;
    if (storage == "reset") modifier.storage = graphic::Storage::Reset;
    return modifier;
  }

  Pin point_in(pugi::xml_node point) {
    Pin pin;
    pin.position = place(child(point, "relPosition"));
    for (const pugi::xml_node node : point.children()) {
      if (local_name(node) != "connection") continue;
      graphic::Connection connection;
      connection.from = context_.number(node, "refLocalId").value_or(0);
      connection.output = node.attribute("formalParameter").value();
      for (const pugi::xml_node position : node.children())
        if (local_name(position) == "position") connection.path.push_back(*place(position));
      connection.extra = extra_of(node, {"refLocalId", "formalParameter"}, {"position"});
      pin.connections.push_back(std::move(connection));
    }
    pin.expression = context_.file().source_text(child(point, "expression"));
    pin.point_extra = extra_of(point, {}, {"relPosition", "connection", "expression"});
    return pin;
  }

  Pin point_out(pugi::xml_node point) {
    Pin pin;
    pin.name = point.attribute("formalParameter").value();
    pin.position = place(child(point, "relPosition"));
    pin.expression = context_.file().source_text(child(point, "expression"));
    pin.point_extra = extra_of(point, {"formalParameter"}, {"relPosition", "expression"});
    return pin;
  }

  void pins(pugi::xml_node node, Element& element) {
    for (const pugi::xml_node each : node.children()) {
      const std::string_view name = local_name(each);
      if (name == "connectionPointIn") element.inputs.push_back(point_in(each));
      if (name == "connectionPointOut") element.outputs.push_back(point_out(each));
      if (name == "connectionPointOutAction") element.action_output = point_out(each);
      if (name == "inputVariables") variables(each, true, element.inputs);
      if (name == "inOutVariables") variables(each, true, element.in_outs);
      if (name == "outputVariables") variables(each, false, element.outputs);
    }
  }

  void variables(pugi::xml_node list, bool input, std::vector<Pin>& pins) {
    for (const pugi::xml_node node : list.children()) {
      if (local_name(node) != "variable") continue;
      const pugi::xml_node in = child(node, "connectionPointIn");
      const pugi::xml_node out = child(node, "connectionPointOut");
      Pin pin = input ? point_in(in) : point_out(out);
      pin.has_point = input ? static_cast<bool>(in) : static_cast<bool>(out);
      pin.name = node.attribute("formalParameter").value();
      pin.modifier = modifier(node);
      pin.documentation = context_.documentation(node);
      pin.extra =
          extra_of(node, {"formalParameter", "negated", "edge", "storage"},
                   input ? std::initializer_list<std::string_view>{"connectionPointIn", "documentation"}
                         : std::initializer_list<std::string_view>{"connectionPointOut", "documentation"});
      pins.push_back(std::move(pin));
    }
  }

  static graphic::SourceText plain(std::string text) { return {std::move(text), {}}; }

  // What elements of its kind have.
  void own(pugi::xml_node node, Element& element) {
    const XmlFile& file = context_.file();
    switch (element.kind) {
      case ElementKind::Comment:
      case ElementKind::Error:
        element.name = file.source_text(child(node, "content"));
        break;
      case ElementKind::VendorElement:
        element.name = file.source_text(child(node, "alternativeText"));
        break;
      case ElementKind::Contact:
      case ElementKind::Coil:
        element.name = file.source_text(child(node, "variable"));
        element.modifier = modifier(node);
        break;
      case ElementKind::InVariable:
      case ElementKind::OutVariable:
        element.name = file.source_text(child(node, "expression"));
        element.modifier = modifier(node);
        break;
      case ElementKind::InOutVariable:
        element.name = file.source_text(child(node, "expression"));
        element.modifier = modifier(node, "In");
        element.output_modifier = modifier(node, "Out");
        break;
      case ElementKind::Block:
        element.name = plain(context_.required(node, "typeName"));
        element.instance = node.attribute("instanceName").value();
        break;
      case ElementKind::Label:
      case ElementKind::Jump:
        element.name = plain(context_.required(node, "label"));
        break;
      case ElementKind::JumpStep:
        element.name = plain(context_.required(node, "targetName"));
        break;
      case ElementKind::Transition:
        element.priority = context_.number(node, "priority");
        condition(child(node, "condition"), element.condition);
        break;
      case ElementKind::ActionBlock:
        element.modifier = modifier(node);
        actions(node, element);
        break;
      default:
        named(node, element);
        break;
    }
  }

  void named(pugi::xml_node node, Element& element) {
    const bool needed = element.kind == ElementKind::Step || element.kind == ElementKind::Connector ||
                        element.kind == ElementKind::Continuation;
    element.name = plain(needed ? context_.required(node, "name") : node.attribute("name").value());
    element.initial = context_.boolean(node, "initialStep");
    if (element.kind == ElementKind::Step) element.modifier = modifier(node);
  }

  void condition(pugi::xml_node node, graphic::TransitionCondition& condition) {
    condition.negated = context_.boolean(node, "negated");
    if (const pugi::xml_node reference = child(node, "reference")) {
      condition.source = graphic::ConditionSource::Reference;
      condition.reference = context_.required(reference, "name");
    } else if (const pugi::xml_node point = child(node, "connectionPointIn")) {
      condition.source = graphic::ConditionSource::Connection;
      condition.input = point_in(point);
    } else if (const pugi::xml_node inlined = child(node, "inline")) {
      condition.source = graphic::ConditionSource::Inline;
      condition.reference = inlined.attribute("name").value();
      condition.body.push_back(read_body(context_, inlined));
    } else if (child(node, "connection")) {
      // Edition 1 of TC6 has no connection point here.
      condition.source = graphic::ConditionSource::Connection;
      condition.input = point_in(node);
    }
  }

  void actions(pugi::xml_node block, Element& element) {
    for (const pugi::xml_node node : block.children()) {
      if (local_name(node) != "action") continue;
      graphic::DiagramAction action;
      action.qualifier = node.attribute("qualifier").value();
      action.duration = node.attribute("duration").value();
      action.indicator = node.attribute("indicator").value();
      action.reference = child(node, "reference").attribute("name").value();
      if (const pugi::xml_node inlined = child(node, "inline"))
        action.body.push_back(read_body(context_, inlined));
      action.position = place(child(node, "relPosition"));
      action.documentation = context_.documentation(node);
      action.extra = extra_of(node, {"qualifier", "duration", "indicator"},
                              {"reference", "inline", "relPosition", "documentation"});
      action.where = context_.file().offset(node);
      element.actions.push_back(std::move(action));
    }
  }

  ReadContext& context_;
  graphic::Diagram& diagram_;
};

}  // namespace

graphic::DiagramBody read_body(ReadContext& context, pugi::xml_node node) {
  graphic::DiagramBody body;
  body.where = context.file().offset(node);
  body.documentation = context.documentation(node);
  body.extra = extra_of(node, {"name"}, {"ST", "IL", "FBD", "LD", "SFC", "documentation"});
  for (const pugi::xml_node each : node.children()) {
    const std::string_view name = local_name(each);
    if (name == "ST" || name == "IL") {
      body.language =
          name == "ST" ? graphic::BodyLanguage::StructuredText : graphic::BodyLanguage::InstructionList;
      body.text = context.file().source_text(each);
      return body;
    }
    if (name != "FBD" && name != "LD" && name != "SFC") continue;
    body.language = graphic::BodyLanguage::Diagram;
    body.diagram.language = name == "FBD"  ? graphic::DiagramLanguage::FunctionBlocks
                            : name == "LD" ? graphic::DiagramLanguage::Ladder
                                           : graphic::DiagramLanguage::Chart;
    DiagramReader(context, body.diagram).read(each);
    return body;
  }
  context.error(node, code::kNotPlcopen, "the body is in no language",
                "a body holds one of ST, LD, FBD and SFC");
  return body;
}

}  // namespace stepwright::exchange::plcopen

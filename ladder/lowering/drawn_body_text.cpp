#include "ladder/lowering/drawn_body_text.h"

#include <algorithm>

#include "ladder/graphic/identifier.h"
#include "ladder/lowering/condition_guard.h"
#include "ladder/lowering/diagram_to_ladder.h"
#include "ladder/lowering/ladder_to_syntax.h"
#include "ladder/lowering/network_lowering.h"
#include "ladder/source/codes.h"

namespace stepwright::lowering {
namespace {

namespace code = source::code;
using graphic::BodyLanguage;
using graphic::Condition;
using graphic::ConditionKind;
using graphic::Element;
using graphic::ElementKind;

// "name := a AND b;" and ":= a AND b;" as "a AND b", with the number of bytes cut off its front.
std::pair<std::string, std::size_t> expression_of(const std::string& text, const std::string& name) {
  const char* blank = " \t\r\n";
  std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string::npos) return {"", 0};
  const std::size_t assign = text.find(":=");
  if (assign != std::string::npos) {
    std::string target = text.substr(begin, assign - begin);
    target.erase(target.find_last_not_of(blank) + 1);
    if (target.empty() || graphic::same_name(target, name)) begin = text.find_first_not_of(blank, assign + 2);
  }
  if (begin == std::string::npos) return {"", 0};
  std::size_t end = text.find_last_not_of(" \t\r\n;");
  return {text.substr(begin, end + 1 > begin ? end + 1 - begin : 0), begin};
}

}  // namespace

bool DrawnBodyText::refuse(const graphic::DiagramBody& body) {
  const bool list = body.language == BodyLanguage::InstructionList;
  const bool chart =
      body.language == BodyLanguage::Diagram && body.diagram.language == graphic::DiagramLanguage::Chart;
  if (list)
    scope_.error(code::kExchangeUnsupported, body.where, "instruction lists are not supported",
                 "write the body in ST");
  if (chart)
    scope_.error(code::kExchangeUnsupported, body.where, "a chart inside a chart is not supported",
                 "make it a function block of its own");
  return list || chart;
}

std::string DrawnBodyText::statements(const graphic::DiagramBody& body) {
  if (refuse(body)) return {};
  if (body.language == BodyLanguage::Diagram) return ladder_statements(body);
  return scope_.piece(body.text);
}

bool DrawnBodyText::refuse_jumps(const graphic::LadderProgram& ladder, const graphic::DiagramBody& body,
                                 const char* what) {
  for (const graphic::Rung& rung : ladder.rungs) {
    if (rung.label.empty() && rung.jump_to.empty() && !rung.is_return) continue;
    scope_.error(code::kExchangeUnsupported, body.where,
                 std::string("jumps and labels in ") + what + " are not supported",
                 "call a function block that jumps");
    return true;
  }
  return false;
}

std::string DrawnBodyText::ladder_statements(const graphic::DiagramBody& body) {
  const graphic::LadderProgram ladder = diagram_to_ladder(body.diagram, scope_);
  if (refuse_jumps(ladder, body, "an action")) return {};
  LadderText text = ladder_text(ladder, scope_.new_wire());
  for (graphic::Wire& wire : text.variables) variables_.push_back(std::move(wire));
  return text.statements;
}

Condition DrawnBodyText::expression(const graphic::DiagramBody& body, const std::string& name) {
  Condition result;
  const auto [text, skipped] = expression_of(body.text.text, name);
  const std::string fault = fault_of_expression(text);
  if (!fault.empty()) {
    scope_.error(code::kBadDiagram, body.where, "the condition of the transition: " + fault,
                 "write a BOOL expression of ST");
    return result;
  }
  if (graphic::same_name(text, "TRUE")) return result;
  graphic::SourceText piece{text, {}};
  for (graphic::TextAnchor anchor : body.text.anchors) {
    if (anchor.text >= skipped) {
      piece.anchors.push_back({static_cast<std::uint32_t>(anchor.text - skipped), anchor.file});
    } else {
      const auto delta = static_cast<std::uint32_t>(skipped - anchor.text);
      piece.anchors.assign(1, {0, anchor.file + delta});
    }
  }
  result.kind = ConditionKind::Expression;
  result.name = scope_.piece(piece);
  return result;
}

DrawnCondition DrawnBodyText::condition(const graphic::DiagramBody& body, const std::string& name) {
  DrawnCondition result;
  if (refuse(body)) return result;
  if (body.language == BodyLanguage::StructuredText) {
    result.value = expression(body, name);
    return result;
  }
  const DiagramGraph graph(body.diagram, scope_);
  NetworkLowering lowering(graph, scope_);
  const Element* output = nullptr;
  for (const Network& network : graph.networks()) {
    Network others = network;
    const auto is_output = [&](const Element* each) {
      const bool writes = each->kind == ElementKind::Coil || each->kind == ElementKind::OutVariable;
      return writes && graphic::same_name(each->name.text, name);
    };
    const auto found = std::find_if(others.doers.begin(), others.doers.end(), is_output);
    if (found != others.doers.end()) output = *found;
    others.doers.erase(std::remove_if(others.doers.begin(), others.doers.end(), is_output),
                       others.doers.end());
    lowering.lower(others);
  }
  if (output == nullptr || output->inputs.empty()) {
    scope_.error(code::kBadDiagram, body.where, "nothing is written to the transition '" + name + "'",
                 "end the network with a variable or coil of that name");
  } else {
    result.value = lowering.evaluate_output(*output);
  }
  graphic::LadderProgram ladder = lowering.take();
  if (!refuse_jumps(ladder, body, "a transition")) result.statements = guarded(std::move(ladder));
  return result;
}

std::string DrawnBodyText::guarded(graphic::LadderProgram network) {
  if (only_reads(network)) {
    std::move(network.rungs.begin(), network.rungs.end(), std::back_inserter(networks_.rungs));
    std::move(network.wires.begin(), network.wires.end(), std::back_inserter(networks_.wires));
    return {};
  }
  for (graphic::Rung& rung : network.rungs) sense_edges(rung.condition, network);
  LadderText text = ladder_text(network, scope_.new_wire());
  for (graphic::Wire& wire : text.variables) variables_.push_back(std::move(wire));
  return text.statements;
}

// The edge of a variable is sensed in every scan, also where the network does not run. That of a wire, which
// the network computes, is one between two of its runs.
void DrawnBodyText::sense_edges(Condition& condition, const graphic::LadderProgram& network) {
  for (Condition& child : condition.children) sense_edges(child, network);
  const bool of_wire =
      std::any_of(network.wires.begin(), network.wires.end(),
                  [&](const graphic::Wire& wire) { return graphic::same_name(wire.name, condition.name); });
  if (condition.edge == graphic::Edge::None || of_wire) return;
  const std::string name = scope_.new_wire();
  networks_.wires.push_back({name, "BOOL", false});
  graphic::Rung& rung = networks_.rungs.emplace_back();
  rung.condition = condition;
  rung.condition.negated = false;
  rung.coils.push_back({graphic::CoilKind::Normal, name});
  condition = graphic::contact(name, condition.negated);
}

}  // namespace stepwright::lowering

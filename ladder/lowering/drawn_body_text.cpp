#include "ladder/lowering/drawn_body_text.h"

#include <algorithm>

#include "ladder/graphic/identifier.h"
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

std::string DrawnBodyText::ladder_statements(const graphic::DiagramBody& body) {
  const graphic::LadderProgram ladder = diagram_to_ladder(body.diagram, scope_);
  for (const graphic::Rung& rung : ladder.rungs) {
    if (rung.label.empty() && rung.jump_to.empty() && !rung.is_return) continue;
    scope_.error(code::kExchangeUnsupported, body.where, "jumps and labels in an action are not supported",
                 "call a function block that jumps");
    return {};
  }
  LadderText text = ladder_text(ladder, scope_.new_wire());
  for (graphic::Wire& wire : text.variables) variables_.push_back(std::move(wire));
  return text.statements;
}

Condition DrawnBodyText::condition(const graphic::DiagramBody& body, const std::string& name) {
  Condition result;
  if (refuse(body)) return result;
  if (body.language == BodyLanguage::StructuredText) {
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
    result = lowering.evaluate_output(*output);
  }
  graphic::LadderProgram ladder = lowering.take();
  std::move(ladder.rungs.begin(), ladder.rungs.end(), std::back_inserter(networks_.rungs));
  std::move(ladder.wires.begin(), ladder.wires.end(), std::back_inserter(networks_.wires));
  return result;
}

}  // namespace stepwright::lowering

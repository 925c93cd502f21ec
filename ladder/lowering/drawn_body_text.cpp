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

// The part of a text, with the places of its bytes.
graphic::SourceText part_of(const graphic::SourceText& text, std::size_t begin, std::size_t end) {
  graphic::SourceText part{text.text.substr(begin, end - begin), {}};
  for (const graphic::TextAnchor& anchor : text.anchors) {
    if (anchor.text >= begin) {
      part.anchors.push_back({static_cast<std::uint32_t>(anchor.text - begin), anchor.file});
    } else {
      const auto delta = static_cast<std::uint32_t>(begin - anchor.text);
      part.anchors.assign(1, {0, anchor.file + delta});
    }
  }
  return part;
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
  return scope_.piece(body.text, syntax::PieceKind::StatementList, body.where);
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
  for (const std::string& fault : text.faults) scope_.error(code::kBadDiagram, body.where, fault);
  if (!text.faults.empty()) return {};
  for (graphic::Wire& wire : text.variables) variables_.push_back(std::move(wire));
  return text.statements;
}

graphic::SourceText DrawnBodyText::expression_of(const graphic::SourceText& text, const std::string& name) {
  using syntax::TokenKind;
  const std::vector<syntax::Token> tokens = reader_.tokens(text.text);
  std::size_t first = 0;
  std::size_t last = tokens.size() - 1;  // behind the expression
  if (tokens[0].is(TokenKind::Assign)) first = 1;
  if (tokens[0].is(TokenKind::Identifier) && tokens[1].is(TokenKind::Assign) &&
      graphic::same_name(tokens[0].text, name))
    first = 2;
  while (last > first && tokens[last - 1].is(TokenKind::Semicolon)) --last;
  if (first == last) return {};
  return part_of(text, syntax::begin_of(tokens[first], text.text),
                 syntax::end_of(tokens[last - 1], text.text));
}

Condition DrawnBodyText::written_condition(const graphic::DiagramBody& body, const std::string& name) {
  Condition result;
  const graphic::SourceText text = expression_of(body.text, name);
  if (text.text.empty()) {
    scope_.error(code::kBadDiagram, body.where, "the condition of the transition is missing",
                 "write a BOOL expression of ST");
    return result;
  }
  if (graphic::same_name(text.text, "TRUE")) return result;
  std::string condition = scope_.piece(text, syntax::PieceKind::Expression, body.where);
  if (condition.empty()) return result;  // and reported
  result.kind = ConditionKind::Expression;
  result.name = std::move(condition);
  return result;
}

Condition DrawnBodyText::condition(const graphic::DiagramBody& body, const std::string& name) {
  if (refuse(body)) return {};
  if (body.language == BodyLanguage::StructuredText) return written_condition(body, name);
  Condition result;
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

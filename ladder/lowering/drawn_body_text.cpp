#include "ladder/lowering/drawn_body_text.h"

#include <algorithm>

#include "ladder/graphic/identifier.h"
#include "ladder/lowering/condition_guard.h"
#include "ladder/lowering/diagram_to_ladder.h"
#include "ladder/lowering/ladder_to_syntax.h"
#include "ladder/lowering/network_lowering.h"
#include "ladder/lowering/shown_ladder.h"
#include "ladder/lowering/shown_text.h"
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
  if (purpose_ == Purpose::Show) return shown_text(shown_ladder(ladder));
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

DrawnCondition DrawnBodyText::condition(const graphic::DiagramBody& body, const std::string& name) {
  DrawnCondition result;
  if (refuse(body)) return result;
  if (body.language == BodyLanguage::StructuredText) {
    result.value = written_condition(body, name);
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
  if (!refuse_jumps(ladder, body, "a transition")) result.statements = guarded(std::move(ladder), body.where);
  return result;
}

std::string DrawnBodyText::guarded(graphic::LadderProgram network, std::uint32_t where) {
  if (purpose_ == Purpose::Show || only_reads(network)) {
    std::move(network.rungs.begin(), network.rungs.end(), std::back_inserter(networks_.rungs));
    std::move(network.wires.begin(), network.wires.end(), std::back_inserter(networks_.wires));
    return {};
  }
  for (graphic::Rung& rung : network.rungs) sense_edges(rung.condition, network);
  LadderText text = ladder_text(network, scope_.new_wire());
  for (const std::string& fault : text.faults) scope_.error(code::kBadDiagram, where, fault);
  if (!text.faults.empty()) return {};
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

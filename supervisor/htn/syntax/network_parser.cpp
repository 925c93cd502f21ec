#include "supervisor/htn/syntax/network_parser.h"

#include "supervisor/htn/syntax/ordering.h"

namespace stepwright::htn {

using lisp::TokenKind;

namespace {

bool is_ordered(const std::string& keyword) {
  return keyword == ":ordered-subtasks" || keyword == ":ordered-tasks";
}

bool is_subtasks(const std::string& keyword) {
  return keyword == ":subtasks" || keyword == ":tasks" || is_ordered(keyword);
}

}  // namespace

bool NetworkParser::knows(const std::string& keyword) {
  return is_subtasks(keyword) || keyword == ":ordering" || keyword == ":order" || keyword == ":constraints";
}

bool NetworkParser::part(ParsedNetwork& network, const std::string& keyword, Place at) {
  if (is_subtasks(keyword)) {
    network.at = at;
    network.ordered = is_ordered(keyword);
    return subtasks(network);
  }
  return keyword == ":constraints" ? formulas_.formula(network.constraints) : ordering(network);
}

bool NetworkParser::finish(ParsedNetwork& network) {
  return put_in_order(network, tokens_.reporter());
}

// "()", "(and SUBTASK ...)" or one subtask.
bool NetworkParser::subtasks(ParsedNetwork& network) {
  if (!tokens_.at(TokenKind::Open)) return tokens_.unexpected("'(' and the subtasks");
  const lisp::Token& next = tokens_.peek(1);
  if (next.kind == TokenKind::Name && next.text != "and") return subtask(network);
  tokens_.take();
  if (tokens_.accept(TokenKind::Close)) return true;
  if (!tokens_.at(TokenKind::Name, "and")) return tokens_.unexpected("'and', a subtask or ')'");
  tokens_.take();
  while (!tokens_.at(TokenKind::Close))
    if (!subtask(network)) return false;
  return tokens_.expect(TokenKind::Close, "')'");
}

// "(go ?a ?b)" or "(t1 (go ?a ?b))".
bool NetworkParser::subtask(ParsedNetwork& network) {
  ParsedSubtask subtask;
  const bool labelled = tokens_.at(TokenKind::Open) && tokens_.peek(1).kind == TokenKind::Name &&
                        tokens_.peek(2).kind == TokenKind::Open;
  if (labelled) {
    tokens_.take();
    if (!tokens_.expect_name("a label", subtask.label, subtask.label_at)) return false;
  }
  if (!formulas_.call(subtask.call)) return false;
  network.subtasks.push_back(std::move(subtask));
  return !labelled || tokens_.expect(TokenKind::Close, "')'");
}

// "()", "(and (< a b) ...)" or one "(< a b)".
bool NetworkParser::ordering(ParsedNetwork& network) {
  if (!tokens_.at(TokenKind::Open)) return tokens_.unexpected("'(' and the ordering");
  if (tokens_.peek(1).kind == TokenKind::Operator) return order(network);
  tokens_.take();
  if (tokens_.accept(TokenKind::Close)) return true;
  if (!tokens_.at(TokenKind::Name, "and")) return tokens_.unexpected("'and', '(<' or ')'");
  tokens_.take();
  while (!tokens_.at(TokenKind::Close))
    if (!order(network)) return false;
  return tokens_.expect(TokenKind::Close, "')'");
}

bool NetworkParser::order(ParsedNetwork& network) {
  if (!tokens_.expect(TokenKind::Open, "'(< LABEL LABEL)'")) return false;
  if (!tokens_.at(TokenKind::Operator, "<")) return tokens_.unexpected("'<'");
  tokens_.take();
  ParsedOrder order;
  if (!label(order.before) || !label(order.after)) return false;
  network.orders.push_back(std::move(order));
  return tokens_.expect(TokenKind::Close, "')'");
}

bool NetworkParser::label(ParsedTerm& term) {
  return tokens_.expect_name("a label", term.name, term.at);
}

}  // namespace stepwright::htn

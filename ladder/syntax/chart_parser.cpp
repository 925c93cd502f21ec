// Sequential function charts as text (IEC 61131-3, 6.7).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

bool Parser::at_chart() const {
  return at(Keyword::InitialStep) || at(Keyword::Step) || at(Keyword::Transition) || at(Keyword::Action);
}

Chart Parser::chart(Keyword end) {
  Chart result;
  while (!at(end) && !at(TokenKind::End) && !at_pou_start()) {
    if (at(Keyword::InitialStep) || at(Keyword::Step)) {
      result.steps.push_back(step());
    } else if (at(Keyword::Transition)) {
      result.transitions.push_back(transition());
    } else if (at(Keyword::Action)) {
      result.actions.push_back(action());
    } else if (!accept(TokenKind::Semicolon)) {
      unexpected("STEP, TRANSITION or ACTION");
      advance();
    }
  }
  return result;
}

// STEP name : action(qualifier); ... END_STEP
StepDeclaration Parser::step() {
  StepDeclaration result;
  const Token& open = advance();
  result.initial = open.is(Keyword::InitialStep);
  if (const auto name = expect_name("the name of the step")) result.name = *name;
  expect(TokenKind::Colon, "behind the name of the step");
  while (at(TokenKind::Identifier)) {
    result.actions.push_back(action_use());
    if (!expect(TokenKind::Semicolon, "behind the action")) skip_statement();
  }
  expect_end(Keyword::EndStep, open);
  accept(TokenKind::Semicolon);
  return result;
}

// name(qualifier, duration, indicator)
ActionUse Parser::action_use() {
  ActionUse result;
  result.action = *expect_name("the name of an action");
  if (!accept(TokenKind::LeftParen)) return result;
  if (at(TokenKind::Identifier) && (peek(1).is(TokenKind::RightParen) || peek(1).is(TokenKind::Comma))) {
    result.qualifier = peek().text;
    result.qualifier_where = advance().where;
    if (accept(TokenKind::Comma)) {
      if (at(TokenKind::Time) || at(TokenKind::Identifier)) {
        result.duration = advance().text;
      } else {
        unexpected("a duration");
      }
    }
    if (accept(TokenKind::Comma)) {
      if (at(TokenKind::Identifier)) {
        result.indicator = advance().text;
      } else {
        unexpected("the indicator variable");
      }
    }
  } else if (!at(TokenKind::RightParen)) {
    unexpected("a qualifier (N, S, R, L, D, P, P0, P1, SD, DS, SL)");
  }
  expect(TokenKind::RightParen, "to close the action");
  return result;
}

// TRANSITION name (PRIORITY := 1) FROM a TO (b, c) := condition; END_TRANSITION
TransitionDeclaration Parser::transition() {
  TransitionDeclaration result;
  const Token& open = advance();
  result.where = open.where;
  if (at(TokenKind::Identifier)) result.name = expect_name("the name of the transition");
  if (accept(TokenKind::LeftParen)) {
    const auto word = expect_name("PRIORITY");
    if (word && expect(TokenKind::Assign, "behind PRIORITY")) {
      if (at(TokenKind::Integer)) {
        result.priority = advance().integer;
      } else {
        unexpected("a number");
      }
    }
    expect(TokenKind::RightParen, "behind the priority");
  }
  if (expect(Keyword::From, "in the transition")) result.sources = step_list();
  if (expect(Keyword::To, "behind the steps before the transition")) result.targets = step_list();
  if (expect(TokenKind::Assign, "before the condition")) {
    result.condition = slice_until(TokenKind::Semicolon);
    expect(TokenKind::Semicolon, "behind the condition");
  } else {
    slice_until(Keyword::EndTransition);
  }
  expect_end(Keyword::EndTransition, open);
  accept(TokenKind::Semicolon);
  return result;
}

std::vector<Name> Parser::step_list() {
  std::vector<Name> list;
  const bool several = accept(TokenKind::LeftParen);
  do {
    const auto name = expect_name("the name of a step");
    if (!name) break;
    list.push_back(*name);
  } while (several && accept(TokenKind::Comma));
  if (several) expect(TokenKind::RightParen, "behind the steps");
  return list;
}

ActionDeclaration Parser::action() {
  ActionDeclaration result;
  const Token& open = advance();
  if (const auto name = expect_name("the name of the action")) result.name = *name;
  expect(TokenKind::Colon, "behind the name of the action");
  result.body = slice_until(Keyword::EndAction);
  expect_end(Keyword::EndAction, open);
  accept(TokenKind::Semicolon);
  return result;
}

template <typename Kind>
TextSlice Parser::slice_until(Kind until) {
  TextSlice slice;
  slice.where = peek().where;
  const char* begin = peek().text.data();
  const char* end = begin;
  while (!at(until) && !at(TokenKind::End) && !at_pou_start() && !at(Keyword::EndTransition) && !at_chart()) {
    const Token& token = advance();
    end = token.text.data() + token.text.size();
  }
  slice.text = std::string_view(begin, static_cast<std::size_t>(end - begin));
  return slice;
}

}  // namespace stepwright::syntax::internal

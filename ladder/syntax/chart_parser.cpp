// Sequential function charts as text (IEC 61131-3, 6.7).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

bool Parser::at_chart() const {
  return at(Keyword::InitialStep) || at(Keyword::Step) || at(Keyword::Transition) || at(Keyword::Action) ||
         at(Keyword::FinalScan);
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
    } else if (accept(Keyword::FinalScan)) {
      result.final_scan = true;
    } else if (!accept(TokenKind::Semicolon)) {
      unexpected("STEP, TRANSITION or ACTION");
      while (!at(end) && !at(TokenKind::End) && !at_pou_start() && !at_chart()) advance();
    }
  }
  return result;
}

// STEP name : action(qualifier); ... END_STEP
StepDeclaration Parser::step() {
  StepDeclaration result;
  const Token& open = advance();
  result.initial = open.is(Keyword::InitialStep);
  if (const auto name = expect_name("the name of the step")) {
    result.name = *name;
  } else if (at(Keyword::Step) || at(Keyword::InitialStep)) {
    // The word twice: the name comes behind it.
    advance();
    if (at(TokenKind::Identifier)) result.name = *expect_name("the name of the step");
  }
  expect(TokenKind::Colon, "behind the name of the step");
  while (!at(Keyword::EndStep) && !at(TokenKind::End) && !at_pou_start() && !at_chart()) {
    const std::size_t before = at_;
    if (at(TokenKind::Identifier)) {
      result.actions.push_back(action_use());
      if (!expect(TokenKind::Semicolon, "behind the action")) skip_statement();
    } else {
      unexpected("the name of an action");
      skip_statement();
    }
    if (at_ == before) break;
  }
  expect_end(Keyword::EndStep, open);
  accept(TokenKind::Semicolon);
  return result;
}

namespace {

// Table 45: the second argument of an action block is its duration, or an indicator already.
bool takes_duration(std::string_view qualifier) {
  const std::string folded = source::upper(qualifier);
  return folded == "L" || folded == "D" || folded == "SD" || folded == "DS" || folded == "SL";
}

}  // namespace

// name(qualifier, duration, indicator, ...); without a qualifier indicators may follow: name(, indicator)
ActionUse Parser::action_use() {
  ActionUse result;
  result.action = *expect_name("the name of an action");
  if (!accept(TokenKind::LeftParen)) return result;
  const bool qualified = at(TokenKind::Identifier) && !peek(1).is(TokenKind::Dot);
  if (qualified || at(TokenKind::Comma)) {
    result.qualifier_where = peek().where;
    if (qualified) result.qualifier = advance().text;
    if (takes_duration(result.qualifier) && accept(TokenKind::Comma))
      result.duration = action_argument("a duration");
    while (accept(TokenKind::Comma)) {
      // Where none belongs it is kept, for a diagnostic that says so.
      if (at(TokenKind::Time)) {
        result.duration = action_argument("a duration");
      } else {
        result.indicators.push_back(action_argument("the indicator variable"));
      }
    }
  } else if (!at(TokenKind::RightParen)) {
    unexpected("a qualifier (N, S, R, L, D, P, P0, P1, SD, DS, SL)");
  }
  expect(TokenKind::RightParen, "to close the action");
  return result;
}

// A duration literal, or a variable and its members: "T#2s", "delay", "settings.delay".
TextSlice Parser::action_argument(const char* what) {
  TextSlice slice;
  slice.where = peek().where;
  if (!at(TokenKind::Time) && !at(TokenKind::Identifier)) {
    unexpected(what);
    return slice;
  }
  const char* begin = peek().text.data();
  const bool variable = at(TokenKind::Identifier);
  std::string_view last = advance().text;
  while (variable && at(TokenKind::Dot) && peek(1).is(TokenKind::Identifier)) {
    advance();
    last = advance().text;
  }
  slice.text = std::string_view(begin, static_cast<std::size_t>(last.data() + last.size() - begin));
  return slice;
}

// TRANSITION name (PRIORITY := 1) FROM a TO (b, c) := condition; END_TRANSITION
TransitionDeclaration Parser::transition() {
  TransitionDeclaration result;
  const Token& open = advance();
  result.where = open.where;
  if (at(TokenKind::Identifier)) result.name = expect_name("the name of the transition");
  if (accept(TokenKind::LeftParen)) result.priority = transition_priority();
  if (expect(Keyword::From, "in the transition")) result.sources = step_list();
  if (expect(Keyword::To, "behind the steps before the transition")) result.targets = step_list();
  transition_condition(result);
  expect_end(Keyword::EndTransition, open);
  accept(TokenKind::Semicolon);
  return result;
}

// PRIORITY := 1)
std::optional<std::uint64_t> Parser::transition_priority() {
  std::optional<std::uint64_t> priority;
  const auto word = expect_name("PRIORITY");
  if (word && source::upper(word->text) != "PRIORITY") {
    context_.sink.error(source::code::kUnexpectedToken, word->where, "expected PRIORITY in the transition",
                        "write TRANSITION name (PRIORITY := 1) FROM ...");
  }
  if (word && expect(TokenKind::Assign, "behind PRIORITY")) {
    if (!at(TokenKind::Integer)) {
      unexpected("a number");
    } else if (peek().integer > 0xFFFF) {
      context_.sink.error(source::code::kBadChart, peek().where, "a priority is a number from 0 to 65535",
                          "the smaller number goes first");
      advance();
    } else {
      priority = advance().integer;
    }
  }
  expect(TokenKind::RightParen, "behind the priority");
  return priority;
}

void Parser::transition_condition(TransitionDeclaration& result) {
  // What cannot be read is reported here and nowhere else.
  result.condition = {"TRUE", peek().where};
  if (at(TokenKind::Colon)) {
    context_.sink.error(source::code::kNotSupported, advance().where,
                        "a condition that is a diagram or an instruction list has no form in this text",
                        "write ':=' and an ST expression; drawn conditions come with a PLCopen XML file");
    slice_until(Keyword::EndTransition);
    return;
  }
  if (!expect(TokenKind::Assign, "before the condition")) {
    slice_until(Keyword::EndTransition);
    return;
  }
  if (at(TokenKind::Semicolon)) {
    unexpected("a condition");
    advance();
    return;
  }
  const std::size_t first = at_;
  const std::size_t errors = context_.sink.error_count();
  expression();
  if (context_.sink.error_count() == errors) result.condition = slice_from(first);
  // What stands behind a mistake belongs to it.
  if (!expect(TokenKind::Semicolon, "behind the condition")) slice_until(Keyword::EndTransition);
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
  const std::size_t first = at_;
  action_statements();
  result.body = slice_from(first);
  expect_end(Keyword::EndAction, open);
  accept(TokenKind::Semicolon);
  return result;
}

// As the body of a POU, except that the last statement may stand without ';'.
void Parser::action_statements() {
  open_end_ = true;
  while (!at(Keyword::EndAction) && !at(TokenKind::End) && !at_pou_start() && !at_chart()) {
    statements();
    if (at(Keyword::EndAction) || at(TokenKind::End) || at_pou_start() || at_chart()) break;
    unexpected("a statement");
    advance();
  }
  open_end_ = false;
}

TextSlice Parser::slice_from(std::size_t first) const {
  TextSlice slice;
  slice.where = tokens_[first].where;
  if (at_ == first) return slice;
  const char* begin = tokens_[first].text.data();
  const Token& last = tokens_[at_ - 1];
  slice.text = std::string_view(begin, static_cast<std::size_t>(last.text.data() + last.text.size() - begin));
  return slice;
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

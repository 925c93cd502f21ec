// Program organisation units and configurations (IEC 61131-3, 6.6 and 6.8).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

PouDeclaration Parser::pou() {
  PouDeclaration result;
  const Token& open = advance();
  Keyword end = Keyword::EndProgram;
  if (open.is(Keyword::FunctionBlock)) {
    result.kind = PouKind::FunctionBlock;
    end = Keyword::EndFunctionBlock;
  } else if (open.is(Keyword::Function)) {
    result.kind = PouKind::Function;
    end = Keyword::EndFunction;
  }
  if (const auto name = expect_name("the name of the POU")) result.name = *name;
  if (result.kind == PouKind::Function) {
    if (accept(TokenKind::Colon)) result.result = type();
  }
  accept(TokenKind::Semicolon);
  while (at_variable_section()) variable_section(result.variables);
  if (at_chart()) {
    result.chart = chart(end);
  } else {
    while (true) {
      Statements more = statements();
      for (auto& each : more) result.body.push_back(std::move(each));
      if (at(TokenKind::End) || at_pou_start()) break;
      // An END_IF too many, a VAR between statements: one report, then on with the body.
      unexpected("a statement");
      if (at_variable_section()) {
        variable_section(result.variables);
      } else {
        advance();
        accept(TokenKind::Semicolon);
      }
    }
  }
  result.end = peek().where;
  expect_end(end, open);
  accept(TokenKind::Semicolon);
  return result;
}

Configuration Parser::configuration() {
  Configuration result;
  const Token& open = advance();
  if (const auto name = expect_name("the name of the configuration")) result.name = *name;
  while (!at(Keyword::EndConfiguration) && !at(TokenKind::End)) {
    const std::size_t before = at_;
    if (at_variable_section()) {
      variable_section(result.globals);
    } else if (at(Keyword::Resource)) {
      resource(result);
    } else {
      resource_item(result);
    }
    if (at_ == before) break;
  }
  expect_end(Keyword::EndConfiguration, open);
  accept(TokenKind::Semicolon);
  return result;
}

void Parser::resource(Configuration& out) {
  const Token& open = advance();
  expect_name("the name of the resource");
  if (accept(Keyword::On)) expect_name("the type of the resource");
  while (!at(Keyword::EndResource) && !at(Keyword::EndConfiguration) && !at(TokenKind::End)) {
    const std::size_t before = at_;
    if (at_variable_section()) {
      variable_section(out.globals);
    } else {
      resource_item(out);
    }
    if (at_ == before) break;
  }
  expect_end(Keyword::EndResource, open);
  accept(TokenKind::Semicolon);
}

void Parser::resource_item(Configuration& out) {
  if (at(Keyword::Task)) return task(out);
  if (at(Keyword::Program)) return program_instance(out);
  unexpected("TASK, PROGRAM or VAR_GLOBAL");
  if (!at_pou_start()) advance();
  while (!at(TokenKind::End) && !at_pou_start() && !at(Keyword::Task) && !at(Keyword::EndResource)) {
    if (advance().is(TokenKind::Semicolon)) return;
  }
}

// TASK name (INTERVAL := T#10ms, PRIORITY := 1);
void Parser::task(Configuration& out) {
  advance();
  TaskDeclaration result;
  const auto name = expect_name("the name of the task");
  if (name) result.name = *name;
  if (name && at(TokenKind::LeftParen)) {
    for (Argument& each : arguments()) {
      const std::string formal = each.formal ? source::upper(each.formal->text) : "";
      if (formal == "INTERVAL") {
        result.interval = std::move(each.value);
      } else if (formal == "PRIORITY") {
        result.priority = std::move(each.value);
      } else {
        const source::Position where = each.formal ? each.formal->where : each.value->where;
        context_.sink.error(formal == "SINGLE" ? source::code::kNotSupported : source::code::kBadTask, where,
                            "a task takes INTERVAL and PRIORITY");
      }
    }
  }
  if (name) out.tasks.push_back(std::move(result));
  if (!expect(TokenKind::Semicolon, "behind the task")) skip_statement();
}

// PROGRAM name WITH task : type;
void Parser::program_instance(Configuration& out) {
  advance();
  ProgramDeclaration result;
  const auto name = expect_name("the name of the program instance");
  if (name) result.name = *name;
  bool understood = name.has_value();
  if (accept(Keyword::With)) {
    result.task = expect_name("the name of a task");
    understood = understood && result.task;
  }
  understood = understood && expect(TokenKind::Colon, "before the type of the program");
  if (understood) {
    const auto type = expect_name("the type of the program");
    understood = type.has_value();
    if (type) result.type = *type;
  }
  if (understood) out.programs.push_back(std::move(result));
  if (!understood || !expect(TokenKind::Semicolon, "behind the program instance")) skip_statement();
}

}  // namespace stepwright::syntax::internal

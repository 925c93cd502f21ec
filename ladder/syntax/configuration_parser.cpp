// Configurations, resources, tasks and program instances (IEC 61131-3, 6.8).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

Configuration Parser::configuration() {
  Configuration result;
  const Token& open = advance();
  if (const auto name = expect_name("the name of the configuration")) result.name = *name;
  while (!at(Keyword::EndConfiguration) && !at(TokenKind::End)) {
    const std::size_t before = at_;
    if (at(Keyword::VarConfig)) {
      configured_section(result.configured);
    } else if (at(Keyword::VarAccess)) {
      access_section();
    } else if (at_variable_section()) {
      variable_section(result.globals);
    } else if (at(Keyword::Resource)) {
      result.resources.push_back(resource());
    } else {
      const bool unnamed = !result.resources.empty() && result.resources.back().name.text.empty();
      if (!unnamed) result.resources.emplace_back();
      resource_item(result.resources.back());
    }
    if (at_ == before) break;
  }
  expect_end(Keyword::EndConfiguration, open);
  accept(TokenKind::Semicolon);
  return result;
}

Resource Parser::resource() {
  Resource result;
  const Token& open = advance();
  if (const auto name = expect_name("the name of the resource")) result.name = *name;
  if (accept(Keyword::On)) expect_name("the type of the resource");
  while (!at(Keyword::EndResource) && !at(Keyword::EndConfiguration) && !at(TokenKind::End)) {
    const std::size_t before = at_;
    if (at_variable_section()) {
      variable_section(result.globals);
    } else {
      resource_item(result);
    }
    if (at_ == before) break;
  }
  expect_end(Keyword::EndResource, open);
  accept(TokenKind::Semicolon);
  return result;
}

void Parser::resource_item(Resource& out) {
  if (at(Keyword::Task)) return task(out);
  if (at(Keyword::Program)) return program_instance(out);
  if (accept(TokenKind::Semicolon)) return;
  unexpected("TASK, PROGRAM or VAR_GLOBAL");
  if (!at_pou_start()) advance();
  skip_resource_item();
}

// Behind its semicolon, or to what can only be the next item or the end. Where an END_VAR follows sooner, the
// first word of a section is wrong or missing: all of it is skipped.
void Parser::skip_resource_item() {
  constexpr std::size_t kLongestSection = 1'000;  // tokens that are looked through for it
  const std::size_t first = at_;
  std::size_t behind = first;  // the first semicolon
  while (!at(TokenKind::End) && !at_pou_start() && !at_variable_section() && !at(Keyword::VarConfig) &&
         !at(Keyword::VarAccess) && !at(Keyword::Task) && !at(Keyword::EndResource) &&
         !at(Keyword::EndConfiguration)) {
    if (accept(Keyword::EndVar)) return;
    if (advance().is(TokenKind::Semicolon) && behind == first) behind = at_;
    if (behind != first && at_ - first > kLongestSection) break;
  }
  if (behind != first) at_ = behind;
}

// TASK name (INTERVAL := T#10ms, PRIORITY := 1);  TASK name (SINGLE := trigger, PRIORITY := 1);
void Parser::task(Resource& out) {
  advance();
  TaskDeclaration result;
  const auto name = expect_name("the name of the task");
  if (name) result.name = *name;
  if (name && at(TokenKind::LeftParen)) {
    std::vector<Argument> given;
    arguments(given);
    for (Argument& each : given) {
      if (task_argument(each, "INTERVAL")) {
        result.interval = std::move(each.value);
      } else if (task_argument(each, "PRIORITY")) {
        result.priority = std::move(each.value);
      } else if (task_argument(each, "SINGLE")) {
        result.single = std::move(each.value);
      } else if (each.formal || each.value->kind != ExpressionKind::Error) {
        context_.sink.error(source::code::kBadTask, each.formal ? each.formal->where : each.value->where,
                            "a task takes SINGLE, INTERVAL and PRIORITY",
                            "write (INTERVAL := T#10ms, PRIORITY := 1)");
      }
    }
  }
  if (name) out.tasks.push_back(std::move(result));
  if (!expect(TokenKind::Semicolon, "behind the task")) skip_resource_item();
}

bool Parser::task_argument(const Argument& argument, const char* name) {
  return argument.formal && !argument.is_output && source::upper(argument.formal->text) == name;
}

// PROGRAM RETAIN name WITH task : type (in := global, out => global);
void Parser::program_instance(Resource& out) {
  advance();
  ProgramDeclaration result;
  result.retain = accept(Keyword::Retain);
  result.non_retain = accept(Keyword::NonRetain);
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
  if (understood && at(TokenKind::LeftParen)) program_elements(result);
  result.broken = !understood;
  if (name) out.programs.push_back(std::move(result));
  if (!understood || !expect(TokenKind::Semicolon, "behind the program instance")) skip_resource_item();
}

// "(in := global, out => global, block WITH task)"
void Parser::program_elements(ProgramDeclaration& out) {
  advance();
  if (accept(TokenKind::RightParen)) return;
  do {
    if (at(TokenKind::Identifier) && peek(1).is(Keyword::With)) {
      BlockTask each;
      each.block = *expect_name("a function block");
      advance();
      const auto task = expect_name("the name of a task");
      if (!task) break;
      each.task = *task;
      out.block_tasks.push_back(each);
    } else {
      out.connections.push_back(argument());
    }
  } while (accept(TokenKind::Comma));
  expect(TokenKind::RightParen, "to close the connections of the program");
}

// VAR_ACCESS name : [resource.][program.][block.]variable : type READ_WRITE; END_VAR (6.8.1)
void Parser::access_section() {
  const Token& open = advance();
  while (!at(TokenKind::End) && !at(TokenKind::Keyword)) {
    if (accept(TokenKind::Semicolon)) continue;
    if (!access_line()) skip_declaration();
  }
  expect_end(Keyword::EndVar, open);
}

bool Parser::access_line() {
  const auto name = expect_name("the name of an access path");
  if (!name || !expect(TokenKind::Colon, "behind the name of the access path") || !access_path())
    return false;
  if (!expect(TokenKind::Colon, "behind the path") || type()->kind == TypeKind::Error) return false;
  if (at_word("READ_ONLY") || at_word("READ_WRITE")) advance();
  context_.sink.warning(source::code::kAccessPath, name->where,
                        "no client can name the access path '" + std::string(name->text) + "'",
                        "clients read and write variables by their own names, as in main.level");
  return expect(TokenKind::Semicolon, "behind the access path");
}

bool Parser::access_path() {
  do {
    if (at(TokenKind::Direct)) return direct_address().has_value();
    if (!expect_name("a path of names, or an address")) return false;
    if (!accept(TokenKind::LeftBracket)) continue;
    do expression();
    while (accept(TokenKind::Comma));
    if (!expect(TokenKind::RightBracket, "to close the index")) return false;
  } while (accept(TokenKind::Dot));
  return true;
}

void Parser::configured_section(std::vector<ConfiguredVariable>& out) {
  const Token& open = advance();
  while (!at(TokenKind::End) && !at(TokenKind::Keyword)) {
    if (accept(TokenKind::Semicolon)) continue;
    if (!configured_line(out)) skip_declaration();
  }
  expect_end(Keyword::EndVar, open);
}

// resource.program.block.variable AT %IX0.0 : BOOL := TRUE;
bool Parser::configured_line(std::vector<ConfiguredVariable>& out) {
  ConfiguredVariable line;
  do {
    const auto name = expect_name("the path of a variable");
    if (!name) return false;
    line.path.push_back(*name);
  } while (accept(TokenKind::Dot));
  if (accept(Keyword::At)) {
    line.address_where = peek().where;
    if (!at(TokenKind::Direct)) return expect(TokenKind::Direct, "behind AT");
    line.address = direct_address();
    if (!line.address) return false;
  }
  if (!expect(TokenKind::Colon, "behind the path of the variable")) return false;
  line.type = type();
  if (line.type->kind == TypeKind::Error) return false;
  if (accept(TokenKind::Assign)) line.initial = initial_value();
  out.push_back(std::move(line));
  return expect(TokenKind::Semicolon, "behind the variable");
}

}  // namespace stepwright::syntax::internal

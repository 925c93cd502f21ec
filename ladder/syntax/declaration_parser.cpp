// Variables (IEC 61131-3, 6.5).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

namespace {

std::optional<Section> section_of(const Token& token) {
  if (!token.is(TokenKind::Keyword)) return std::nullopt;
  switch (token.keyword) {
    case Keyword::Var:
      return Section::Local;
    case Keyword::VarTemp:
      return Section::Temp;
    case Keyword::VarInput:
      return Section::Input;
    case Keyword::VarOutput:
      return Section::Output;
    case Keyword::VarInOut:
      return Section::InOut;
    case Keyword::VarExternal:
      return Section::External;
    case Keyword::VarGlobal:
      return Section::Global;
    default:
      return std::nullopt;
  }
}

}  // namespace

bool Parser::at_variable_section() const {
  return section_of(peek()).has_value();
}

void Parser::variable_section(std::vector<VariableDeclaration>& out) {
  const Token& open = advance();
  VariableDeclaration model;
  model.section = *section_of(open);
  while (true) {
    if (accept(Keyword::Constant)) {
      model.constant = true;
    } else if (accept(Keyword::Retain)) {
      model.retain = true;
    } else if (accept(Keyword::NonRetain)) {
      model.non_retain = true;
    } else {
      break;
    }
  }
  while (!at(TokenKind::End) && !at_test_declaration() &&
         (!at(TokenKind::Keyword) || at(Keyword::At) || at_reserved_name())) {
    if (accept(TokenKind::Semicolon)) continue;
    if (!variable_line(model, out)) skip_declaration();
  }
  expect_end(Keyword::EndVar, open);
}

// "VAR step : INT;": a reserved word where only a name can be meant.
bool Parser::at_reserved_name() const {
  const Token& next = peek(1);
  return at(TokenKind::Keyword) && !at(Keyword::EndVar) &&
         (next.is(TokenKind::Colon) || next.is(TokenKind::Comma) || next.is(Keyword::At));
}

bool Parser::variable_line(const VariableDeclaration& model, std::vector<VariableDeclaration>& out) {
  VariableDeclaration line;
  line.section = model.section;
  line.constant = model.constant;
  line.retain = model.retain;
  line.non_retain = model.non_retain;
  if (!at(Keyword::At) && !variable_names(line)) return false;
  if (accept(Keyword::At) && !variable_address(line)) return false;
  if (!expect(TokenKind::Colon, "behind the name of the variable")) return false;
  line.type = type();
  const bool understood = line.type->kind != TypeKind::Error;
  if (accept(Keyword::RisingEdge)) line.edge = Edge::Rising;
  if (accept(Keyword::FallingEdge)) line.edge = Edge::Falling;
  if (understood && accept(TokenKind::Assign)) line.initial = initial_value();
  // Declared in any case, so that its uses are not reported too.
  out.push_back(std::move(line));
  if (!understood) return false;
  return expect(TokenKind::Semicolon, "behind the declaration");
}

bool Parser::variable_names(VariableDeclaration& line) {
  do {
    const bool reserved = at_reserved_name();
    const auto name = expect_name("the name of a variable");
    if (!name && !reserved) return false;
    if (name) line.names.push_back(*name);
    // The other names of the line are good ones.
    if (reserved) advance();
  } while (accept(TokenKind::Comma));
  return !line.names.empty();
}

// Behind AT: an address, or one that VAR_CONFIG completes ("%I*", "%QW*").
bool Parser::variable_address(VariableDeclaration& line) {
  line.address_where = peek().where;
  if (!at(TokenKind::Direct)) return expect(TokenKind::Direct, "behind AT");
  const std::string text = source::upper(peek().text);
  const std::size_t area = text.size() > 1 ? std::string_view("IQM").find(text[1]) : std::string::npos;
  const bool sized = text.size() == 4 && std::string_view("XBWDL").find(text[2]) != std::string::npos;
  if (text.back() == '*' && area != std::string::npos && (text.size() == 3 || sized)) {
    advance();
    line.open_address = static_cast<Area>(area);
    return true;
  }
  line.address = direct_address();
  return true;
}

}  // namespace stepwright::syntax::internal

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

bool Parser::begins_section(const Token& token) {
  return section_of(token).has_value();
}

bool Parser::at_variable_section() const {
  return begins_section(peek());
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
    } else if (accept_modifier()) {
      continue;
    } else {
      break;
    }
  }
  variable_lines(model, out);
  expect_end(Keyword::EndVar, open);
}

void Parser::variable_lines(const VariableDeclaration& model, std::vector<VariableDeclaration>& out) {
  while (!at(TokenKind::End) && !at_test_declaration() &&
         (!at(TokenKind::Keyword) || at(Keyword::At) || at_reserved_name())) {
    if (accept(TokenKind::Semicolon)) continue;
    // The section was not closed, and this is the body.
    if (at_bare_statement()) return;
    if (!variable_line(model, out)) skip_declaration();
  }
}

// "x : INT", "x, y : INT": the names of a declaration and what follows them.
bool Parser::at_declaration() const {
  for (std::size_t i = 0; peek(i).is(TokenKind::Identifier); i += 2) {
    const Token& next = peek(i + 1);
    if (next.is(TokenKind::Colon) || next.is(Keyword::At)) return true;
    if (!next.is(TokenKind::Comma)) return false;
  }
  return false;
}

// What can be a statement and no declaration.
bool Parser::at_bare_statement() const {
  const Token& next = peek(1);
  const bool calls =
      next.is(TokenKind::LeftParen) && (peek(2).is(TokenKind::RightParen) || peek(3).is(TokenKind::Assign));
  return at(TokenKind::Identifier) && (calls || next.is(TokenKind::Assign) || next.is(TokenKind::Dot) ||
                                       next.is(TokenKind::LeftBracket) || next.is(TokenKind::Caret));
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
  if (!at(Keyword::At) && !variable_names(line)) {
    // Its name is lost, not that there is one more: calls that give it an argument are right.
    line.type = std::make_unique<TypeSpec>();
    out.push_back(std::move(line));
    return false;
  }
  const bool understood = typed_line(line);
  // Declared in any case, so that its uses are not reported too.
  if (!understood) line.type = std::make_unique<TypeSpec>();
  out.push_back(std::move(line));
  if (!understood) return false;
  return expect(TokenKind::Semicolon, "behind the declaration");
}

// Behind the names.
bool Parser::typed_line(VariableDeclaration& line) {
  if (accept(Keyword::At) && !variable_address(line)) return false;
  if (!expect(TokenKind::Colon, "behind the name of the variable")) return false;
  line.type = type();
  if (line.type->kind == TypeKind::Error) return false;
  if (accept(Keyword::RisingEdge)) line.edge = Edge::Rising;
  if (accept(Keyword::FallingEdge)) line.edge = Edge::Falling;
  if (accept(TokenKind::Assign)) line.initial = initial_value();
  return true;
}

bool Parser::variable_names(VariableDeclaration& line) {
  bool sound = true;
  do {
    const bool reserved = at_reserved_name();
    const auto name = expect_name("the name of a variable");
    sound = name || reserved;
    if (name) line.names.push_back(*name);
    // The other names of the line are good ones.
    if (reserved) advance();
  } while (sound && accept(TokenKind::Comma));
  if (!at(TokenKind::Colon) && !at(Keyword::At)) unexpected("':' behind the name of the variable");
  // A list with a mistake: its other names are declared too, so that their uses are not reported.
  while (at(TokenKind::Identifier) || at(TokenKind::Comma)) {
    const Token& token = advance();
    if (token.is(TokenKind::Identifier)) line.names.push_back({token.name, token.text, token.where});
    reported_at_ = at_;
  }
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
  if (in_structure_ && area == std::string::npos) return relative_address(line);
  line.address = direct_address();
  return true;
}

// Behind AT in a structure (6.4.4.7).
bool Parser::relative_address(VariableDeclaration& line) {
  constexpr std::uint32_t kLimit = 32u << 20;  // of a type
  const Token& token = advance();
  line.relative = parse_relative(token.text, kLimit);
  if (line.relative) return true;
  context_.sink.error(source::code::kBadAddress, token.where,
                      "'" + std::string(token.text) + "' is no place in a structure",
                      "places look like %X3.0, %B4, %W2, %D4 or %L8; the first number counts bytes");
  return false;
}

}  // namespace stepwright::syntax::internal

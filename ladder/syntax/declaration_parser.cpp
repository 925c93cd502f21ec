// Variables and types (IEC 61131-3, 6.4 and 6.5).

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
    } else if (!accept(Keyword::NonRetain)) {
      break;
    }
  }
  while (!at(TokenKind::End) && (!at(TokenKind::Keyword) || at_reserved_name())) {
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
  do {
    const bool reserved = at_reserved_name();
    const auto name = expect_name("the name of a variable");
    if (!name && !reserved) return false;
    if (name) line.names.push_back(*name);
    // The other names of the line are good ones.
    if (reserved) advance();
  } while (accept(TokenKind::Comma));
  if (line.names.empty()) return false;
  if (accept(Keyword::At)) {
    line.address_where = peek().where;
    const std::string text(peek().text);
    if (!expect(TokenKind::Direct, "behind AT")) return false;
    line.address = naming::parse_direct_address(text);
    if (!line.address)
      context_.sink.error(source::code::kBadAddress, line.address_where, "'" + text + "' is no address",
                          "addresses look like %IX0.0, %QB1, %MW2, %ID3 or %ML4");
  }
  if (!expect(TokenKind::Colon, "behind the name of the variable")) return false;
  line.type = type();
  const bool understood = line.type->kind != TypeKind::Error;
  if (understood && accept(TokenKind::Assign)) line.initial = initial_value();
  // Declared in any case, so that its uses are not reported too.
  out.push_back(std::move(line));
  if (!understood) return false;
  return expect(TokenKind::Semicolon, "behind the declaration");
}

TypeSpecPtr Parser::type() {
  const Nesting nesting(*this);
  if (!too_deep()) {
    if (at(Keyword::Array)) return array_type();
    if (at(Keyword::Struct)) return struct_type();
    if (at(TokenKind::LeftParen)) return enumeration_type();
  }
  auto spec = std::make_unique<TypeSpec>();
  spec->where = peek().where;
  const auto name = expect_name("a type");
  if (!name) return spec;
  spec->kind = TypeKind::Named;
  spec->name = *name;
  return spec;
}

TypeSpecPtr Parser::array_type() {
  auto spec = std::make_unique<TypeSpec>();
  spec->where = advance().where;
  if (!expect(TokenKind::LeftBracket, "behind ARRAY")) return spec;
  do {
    ArrayRange range;
    range.low = expression();
    if (!expect(TokenKind::Range, "between the bounds of the array")) return spec;
    range.high = expression();
    spec->ranges.push_back(std::move(range));
  } while (accept(TokenKind::Comma));
  if (!expect(TokenKind::RightBracket, "behind the bounds of the array")) return spec;
  if (!expect(Keyword::Of, "before the type of the elements")) return spec;
  spec->element = type();
  if (spec->element->kind != TypeKind::Error) spec->kind = TypeKind::Array;
  return spec;
}

TypeSpecPtr Parser::struct_type() {
  auto spec = std::make_unique<TypeSpec>();
  const Token& open = advance();
  spec->where = open.where;
  spec->kind = TypeKind::Struct;
  const VariableDeclaration model;
  while (at(TokenKind::Identifier)) {
    if (!variable_line(model, spec->fields)) skip_declaration();
  }
  expect_end(Keyword::EndStruct, open);
  return spec;
}

TypeSpecPtr Parser::enumeration_type() {
  auto spec = std::make_unique<TypeSpec>();
  spec->where = advance().where;
  do {
    const auto name = expect_name("the name of a value");
    if (!name) return spec;
    Enumerator value;
    value.name = *name;
    if (accept(TokenKind::Assign)) value.value = expression();
    spec->enumerators.push_back(std::move(value));
  } while (accept(TokenKind::Comma));
  if (expect(TokenKind::RightParen, "behind the values")) spec->kind = TypeKind::Enumeration;
  return spec;
}

void Parser::type_section(std::vector<TypeDeclaration>& out) {
  const Token& open = advance();
  while (at(TokenKind::Identifier)) {
    TypeDeclaration declaration;
    declaration.name = *expect_name("the name of the type");
    bool understood = expect(TokenKind::Colon, "behind the name of the type");
    if (understood) {
      declaration.type = type();
      understood = declaration.type->kind != TypeKind::Error;
      if (understood && accept(TokenKind::Assign)) declaration.initial = initial_value();
      out.push_back(std::move(declaration));
      // END_STRUCT may stand without ';'.
      const bool is_struct = out.back().type->kind == TypeKind::Struct;
      if (understood && !(is_struct && !at(TokenKind::Semicolon)))
        understood = expect(TokenKind::Semicolon, "behind the type");
    }
    if (!understood) skip_declaration();
  }
  if (!expect_end(Keyword::EndType, open)) skip_declaration();
}

}  // namespace stepwright::syntax::internal

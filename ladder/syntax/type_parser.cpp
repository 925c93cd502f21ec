// Types (IEC 61131-3, 6.4).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

TypeSpecPtr Parser::type() {
  const Nesting nesting(*this);
  if (!too_deep()) {
    if (at(Keyword::Array)) return array_type();
    if (at(Keyword::Struct)) return struct_type();
    if (at(Keyword::RefTo) || at_pointer()) return reference_type();
    if (at(TokenKind::LeftParen)) return enumeration_type();
  }
  return named_type();
}

// "INT", "INT(0..100)", "STRING[20]", "STRING(20)", "INT(Red := 1, Green)"
TypeSpecPtr Parser::named_type() {
  auto spec = std::make_unique<TypeSpec>();
  spec->where = peek().where;
  const auto name = full_name("a type");
  if (!name) return spec;
  spec->kind = TypeKind::Named;
  spec->name = *name;
  const std::string& folded = context_.names.folded(name->id);
  const bool is_text = folded == "STRING" || folded == "WSTRING";
  if (is_text && (at(TokenKind::LeftBracket) || at(TokenKind::LeftParen))) {
    text_length(*spec);
  } else if (at(TokenKind::LeftParen)) {
    const Token& behind = peek(2);
    const bool names_values =
        peek(1).is(TokenKind::Identifier) &&
        (behind.is(TokenKind::Comma) || behind.is(TokenKind::Assign) || behind.is(TokenKind::RightParen));
    if (names_values) {
      enumerators(*spec);
    } else {
      subrange(*spec);
    }
  }
  return spec;
}

void Parser::text_length(TypeSpec& spec) {
  spec.kind = TypeKind::Error;
  const TokenKind close =
      advance().is(TokenKind::LeftBracket) ? TokenKind::RightBracket : TokenKind::RightParen;
  spec.length = expression();
  if (expect(close, "behind the length of the string")) spec.kind = TypeKind::Text;
}

void Parser::subrange(TypeSpec& spec) {
  spec.kind = TypeKind::Error;
  advance();
  ArrayRange range;
  range.low = expression();
  if (!expect(TokenKind::Range, "between the bounds of the range")) return;
  range.high = expression();
  spec.ranges.push_back(std::move(range));
  if (expect(TokenKind::RightParen, "behind the range")) spec.kind = TypeKind::Subrange;
}

TypeSpecPtr Parser::array_type() {
  auto spec = std::make_unique<TypeSpec>();
  spec->where = advance().where;
  if (!expect(TokenKind::LeftBracket, "behind ARRAY")) return spec;
  do {
    if (!array_range(*spec)) return spec;
  } while (accept(TokenKind::Comma));
  if (!expect(TokenKind::RightBracket, "behind the bounds of the array")) return spec;
  if (!expect(Keyword::Of, "before the type of the elements")) return spec;
  spec->element = type();
  if (spec->element->kind != TypeKind::Error) spec->kind = TypeKind::Array;
  return spec;
}

bool Parser::array_range(TypeSpec& spec) {
  ArrayRange range;
  if (!accept(TokenKind::Star)) {
    range.low = expression();
    if (!expect(TokenKind::Range, "between the bounds of the array")) return false;
    range.high = expression();
  }
  spec.ranges.push_back(std::move(range));
  return true;
}

TypeSpecPtr Parser::struct_type() {
  auto spec = std::make_unique<TypeSpec>();
  const Token& open = advance();
  spec->where = open.where;
  spec->kind = TypeKind::Struct;
  // A member may have this name: no other name stands behind it then.
  spec->overlap = kind_ == TextKind::Written && at_word("OVERLAP") && peek(1).is(TokenKind::Identifier);
  if (spec->overlap) advance();
  const bool outer = std::exchange(in_structure_, true);
  const VariableDeclaration model;
  while (!at(TokenKind::End) && (!at(TokenKind::Keyword) || at_reserved_name())) {
    if (accept(TokenKind::Semicolon)) continue;
    if (!variable_line(model, spec->fields)) skip_declaration();
  }
  in_structure_ = outer;
  expect_end(Keyword::EndStruct, open);
  return spec;
}

TypeSpecPtr Parser::enumeration_type() {
  auto spec = std::make_unique<TypeSpec>();
  spec->where = peek().where;
  enumerators(*spec);
  return spec;
}

// "(Red, Green := 5, Blue)"
void Parser::enumerators(TypeSpec& spec) {
  spec.kind = TypeKind::Error;
  advance();
  do {
    const auto name = expect_name("the name of a value");
    if (!name) return;
    Enumerator value;
    value.name = *name;
    if (accept(TokenKind::Assign)) value.value = expression();
    spec.enumerators.push_back(std::move(value));
  } while (accept(TokenKind::Comma));
  if (expect(TokenKind::RightParen, "behind the values")) spec.kind = TypeKind::Enumeration;
}

// "POINTER TO INT": REF_TO of another system.
bool Parser::at_pointer() const {
  return at_word("POINTER") && peek(1).is(Keyword::To);
}

TypeSpecPtr Parser::reference_type() {
  auto spec = std::make_unique<TypeSpec>();
  spec->where = peek().where;
  if (at_pointer()) {
    if (!context_.dialect->pointers)
      unexpected("REF_TO", source::with_dialects({}, &source::Dialect::pointers));
    advance();
  }
  advance();
  spec->element = type();
  if (spec->element->kind != TypeKind::Error) spec->kind = TypeKind::Reference;
  return spec;
}

// True if the types are INTERNAL to their namespace.
bool Parser::type_section(std::vector<TypeDeclaration>& out) {
  const Token& open = advance();
  const bool internal = accept_internal();
  while (!at(TokenKind::End) && (!at(TokenKind::Keyword) || at_reserved_name())) {
    if (accept(TokenKind::Semicolon)) continue;
    const bool reserved = at_reserved_name();
    const auto name = expect_name("the name of the type");
    if (!name && reserved) advance();
    // A type without a name is read all the same, so that its end is found.
    if (!name && accept(TokenKind::Colon) && type()->kind != TypeKind::Error) continue;
    bool understood = name && expect(TokenKind::Colon, "behind the name of the type");
    if (understood) {
      TypeDeclaration declaration;
      declaration.name = *name;
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
  return internal;
}

}  // namespace stepwright::syntax::internal

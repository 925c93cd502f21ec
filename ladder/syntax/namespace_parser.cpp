// NAMESPACE and USING (IEC 61131-3, 6.9). The words are reserved nowhere: each begins something only before a
// name. What stands in a namespace gets its full name here.

#include "ladder/syntax/internal/parser.h"
#include "ladder/syntax/lexer.h"

namespace stepwright::syntax::internal {

bool Parser::at_namespace() const {
  return kind_ == TextKind::Written && at_word("NAMESPACE") && peek(1).is(TokenKind::Identifier);
}

bool Parser::at_using() const {
  return kind_ == TextKind::Written && at_word("USING") && peek(1).is(TokenKind::Identifier);
}

// True after a report. A full name is as long as a name may be, which bounds how deep namespaces go.
bool Parser::is_too_long(std::size_t characters, source::Position where) {
  if (characters <= kMaxName) return false;
  context_.sink.error(source::code::kLongName, where,
                      "a name with its namespaces has at most " + std::to_string(kMaxName) +
                          " characters, this one has " + std::to_string(characters),
                      "give the namespaces shorter names, or fewer levels");
  return true;
}

// "Plant.Parts": one name; `parts` are its names as they are written.
std::optional<Name> Parser::full_name(const char* what, std::vector<std::string_view>* parts) {
  auto name = expect_name(what);
  if (!name) return name;
  if (parts != nullptr) parts->push_back(name->text);
  std::string folded = context_.names.folded(name->id);
  std::size_t written = name->text.size();
  while (at(TokenKind::Dot) && (peek(1).is(TokenKind::Identifier) || peek(1).is(TokenKind::TypePrefix))) {
    advance();
    const Token& next = advance();
    folded += "." + context_.names.folded(next.name);
    written = static_cast<std::size_t>(next.text.data() + next.text.size() - name->text.data());
    if (parts != nullptr) parts->push_back(next.text);
  }
  if (folded.size() == name->text.size()) return name;
  if (is_too_long(folded.size(), name->where)) return std::nullopt;
  name->id = context_.names.intern(folded);
  // Blanks and comments may stand around the dots.
  const bool is_whole = written == folded.size();
  name->text = is_whole ? std::string_view(name->text.data(), written) : context_.names.folded(name->id);
  return name;
}

void Parser::using_directives(std::vector<Name>& out) {
  while (at_using()) {
    advance();
    do {
      if (const auto name = full_name("the name of a namespace")) out.push_back(*name);
    } while (accept(TokenKind::Comma));
    expect(TokenKind::Semicolon, "behind the namespaces");
  }
}

// INTERNAL before a name. Outside of all namespaces it excludes nobody.
bool Parser::accept_internal() {
  const bool here = kind_ == TextKind::Written && at_word("INTERNAL") && peek(1).is(TokenKind::Identifier);
  if (here) advance();
  return here;
}

// The full name of what was declared in the namespace that is open.
void Parser::qualify(Unit& out, Name& name, bool internal) {
  if (!scope_->space || name.text.empty()) return;
  std::string full = space_text_ + "." + std::string(name.text);
  if (is_too_long(full.size(), name.where)) return;
  name.text = out.spellings.emplace_back(std::move(full));
  name.id = context_.names.intern(name.text);
  if (internal) out.namespaces.push_back({name, scope_->space, false});
}

// Each part of NAMESPACE A.B is a namespace, and the last one is INTERNAL.
void Parser::open_namespace(Unit& out, const Name& name, const std::vector<std::string_view>& parts,
                            bool internal) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::string full = (space_text_.empty() ? "" : space_text_ + ".") + std::string(parts[i]);
    if (is_too_long(full.size(), name.where)) return;
    space_text_ = std::move(full);
    const std::string_view text = out.spellings.emplace_back(space_text_);
    const Name space{context_.names.intern(text), text, name.where};
    const bool is_last = i + 1 == parts.size();
    out.namespaces.push_back({space, internal && is_last ? scope_->space : std::nullopt, true});
    scope_ = &out.scopes.emplace_back(NameScope{scope_, space.id, {}});
  }
}

// To its end, with all that it holds.
void Parser::skip_namespace() {
  std::size_t open = 0;
  do {
    if (at_namespace()) ++open;
    if (at_word("END_NAMESPACE")) --open;
    advance();
  } while (open > 0 && !at(TokenKind::End));
}

void Parser::namespace_block(Unit& out) {
  const Nesting nesting(*this);
  if (is_too_deep()) return skip_namespace();  // so deep a name is too long, which was told
  const Token& open = advance();
  const bool internal = accept_internal();
  NameScope* const outer = scope_;
  const std::string outer_text = space_text_;
  std::vector<std::string_view> parts;
  if (const auto name = full_name("the name of the namespace", &parts))
    open_namespace(out, *name, parts, internal);
  using_directives(scope_->used);
  while (!at(TokenKind::End) && !at_word("END_NAMESPACE")) namespace_part(out);
  if (at_word("END_NAMESPACE")) {
    advance();
    accept(TokenKind::Semicolon);
  } else if (reported_at_ != at_) {
    reported_at_ = at_;
    context_.sink.error(source::code::kMissingEnd, open.where,
                        "'" + std::string(open.text) + "' is not closed: 'END_NAMESPACE' is missing");
  }
  scope_ = outer;
  space_text_ = outer_text;
}

void Parser::namespace_part(Unit& out) {
  if (accept(TokenKind::Semicolon)) return;
  if (at_object()) return skip_object();
  if (at_namespace()) return namespace_block(out);
  if (at(Keyword::Type)) return types_of_unit(out);
  if (at(Keyword::FunctionBlock) || at(Keyword::Function)) return pou_of_unit(out);
  const bool outside =
      at(Keyword::Program) || at(Keyword::VarGlobal) || at(Keyword::Configuration) || at_test_declaration();
  unexpected("FUNCTION_BLOCK, FUNCTION, TYPE, NAMESPACE or END_NAMESPACE",
             outside      ? "programs, global variables, configurations and tests stand outside of namespaces"
             : at_using() ? "USING stands before the declarations of a namespace"
                          : "");
  do advance();
  while (!at(TokenKind::End) && !at_word("END_NAMESPACE") && !at_declaration_of_unit() && !at_object());
}

void Parser::types_of_unit(Unit& out) {
  const std::size_t first = out.types.size();
  const bool internal = type_section(out.types);
  for (std::size_t i = first; i < out.types.size(); ++i) {
    out.types[i].scope = scope_;
    qualify(out, out.types[i].name, internal);
  }
}

void Parser::pou_of_unit(Unit& out) {
  pou_used_.clear();
  PouDeclaration declared = pou();
  enter_scope(out, declared);
  qualify(out, declared.name, internal_pou_);
  out.pous.push_back(std::move(declared));
}

// The scope of a POU that was read, with its own USING.
void Parser::enter_scope(Unit& out, PouDeclaration& pou) {
  pou.scope = scope_;
  if (pou_used_.empty()) return;
  pou.scope = &out.scopes.emplace_back(NameScope{scope_, std::nullopt, std::move(pou_used_)});
  pou_used_.clear();
}

void Parser::globals_of_unit(Unit& out) {
  variable_section(out.globals);
  out.global_scopes.push_back({out.globals.size(), scope_});
}

}  // namespace stepwright::syntax::internal

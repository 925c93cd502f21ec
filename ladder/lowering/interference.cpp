#include "ladder/lowering/interference.h"

#include <algorithm>

#include "ladder/graphic/identifier.h"

namespace stepwright::lowering {

using graphic::Element;
using graphic::ElementKind;
using syntax::Token;
using syntax::TokenKind;

bool Interference::has_effect(const Element& element) const {
  if (element.kind != ElementKind::Block) return does_something(element);
  return !element.instance.empty() || scope_.signature(element.name.text) != nullptr;
}

bool Interference::changes(const Element& effect, const Element& reader) {
  const Names& read = reads(reader);
  const Names& written = writes(effect);
  if (read.own.empty() && !read.is_open) return false;
  if (written.own.empty() && !written.is_open) return false;
  if (read.is_any || written.is_any || (read.is_open && written.is_open)) return true;
  return std::any_of(written.own.begin(), written.own.end(),
                     [&](const std::string& name) { return read.own.count(name) != 0; });
}

const Interference::Names& Interference::reads(const Element& element) {
  const auto [found, is_new] = reads_.try_emplace(&element);
  if (is_new) add_text(found->second, element.name.text, true);
  return found->second;
}

const Interference::Names& Interference::writes(const Element& element) {
  const auto [found, is_new] = writes_.try_emplace(&element);
  if (!is_new) return found->second;
  Names& names = found->second;
  if (element.kind == ElementKind::Coil || element.kind == ElementKind::OutVariable ||
      element.kind == ElementKind::InOutVariable)
    add_text(names, element.name.text, false);
  if (element.kind != ElementKind::Block) return names;
  add_text(names, element.instance, false);
  names.is_open = true;
  for (const graphic::Pin& pin : element.in_outs) {
    add_text(names, pin.expression.text, false);
    for (const graphic::Connection& each : pin.connections)
      if (const Element* source = graph_.from(each).element) add_text(names, source->name.text, false);
  }
  return names;
}

// All variables of the text, or the one that it begins with.
void Interference::add_text(Names& names, const std::string& text, bool whole) {
  const std::vector<Token> tokens = reader_.tokens(text);
  bool is_member = false;
  bool is_first = true;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const Token& token = tokens[i];
    const bool counts = token.is(TokenKind::Identifier) && !is_member && (whole || is_first);
    is_member = token.is(TokenKind::Dot);
    if (token.is(TokenKind::Caret)) names.is_any = names.is_open = true;
    if (token.is(TokenKind::Direct)) names.is_open = true;
    if (!counts) continue;
    is_first = false;
    if (tokens[i + 1].is(TokenKind::LeftParen)) names.calls = names.is_any = names.is_open = true;
    const std::string name(token.text);
    if (scope_.is_private(name)) {
      names.own.insert(graphic::upper(name));
    } else {
      names.is_open = true;
    }
  }
}

}  // namespace stepwright::lowering

#pragma once

// Typed lists, "a b - t c - (either u v)": the objects, parameters and types of PDDL and HDDL.
//
// Thread rule: as the stream from which a list is read.
//
//   std::vector<TypedName> parameters;
//   if (!read_typed_list(tokens, TokenKind::Variable, parameters)) return false;

#include <string>
#include <utility>
#include <vector>

#include "supervisor/lisp/token_stream.h"

namespace stepwright::lisp {

struct TypedName {
  std::string name;
  Place at;
  std::string type_name = "object";  // or "(either a b)"
  Place type_at;
  std::vector<std::string> either;  // the types of an either
};

// The type behind a '-', into the fields of `typed` that say so.
bool read_type(TokenStream& tokens, TypedName& typed);

// Up to, not including, the closing parenthesis. `kind` is Name or Variable; an item is a TypedName with
// whatever else its language knows of it.
template <typename Item>
bool read_typed_list(TokenStream& tokens, TokenKind kind, std::vector<Item>& list) {
  std::size_t untyped = list.size();
  while (!tokens.at(TokenKind::Close)) {
    if (tokens.at(kind)) {
      Item item;
      item.at = tokens.peek().at;
      item.type_at = item.at;
      item.name = tokens.take().text;
      list.push_back(std::move(item));
    } else if (tokens.at(TokenKind::Operator, "-")) {
      tokens.take();
      TypedName type;
      if (!read_type(tokens, type)) return false;
      for (; untyped < list.size(); ++untyped) {
        list[untyped].type_name = type.type_name;
        list[untyped].type_at = type.type_at;
        list[untyped].either = type.either;
      }
    } else {
      const bool variables = kind == TokenKind::Variable;
      return tokens.unexpected(variables ? "a variable, '-' or ')'" : "a name, '-' or ')'",
                               variables ? "variables start with '?'" : "");
    }
  }
  return true;
}

}  // namespace stepwright::lisp

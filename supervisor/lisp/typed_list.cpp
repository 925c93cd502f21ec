#include "supervisor/lisp/typed_list.h"

namespace stepwright::lisp {

bool read_type(TokenStream& tokens, TypedName& typed) {
  typed.type_at = tokens.peek().at;
  Place at;
  if (!tokens.at(TokenKind::Open)) return tokens.expect_name("a type name", typed.type_name, at);
  tokens.take();
  if (!tokens.at(TokenKind::Name, "either")) return tokens.unexpected("'either' or a type name");
  tokens.take();
  typed.type_name = "(either";
  do {
    std::string name;
    if (!tokens.expect_name("a type name", name, at)) return false;
    typed.type_name += " " + name;
    typed.either.push_back(std::move(name));
  } while (!tokens.at(TokenKind::Close));
  typed.type_name += ")";
  return tokens.expect(TokenKind::Close, "')'");
}

}  // namespace stepwright::lisp

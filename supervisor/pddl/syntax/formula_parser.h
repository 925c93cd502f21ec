#pragma once

// The parts that domains and problems share: typed lists, terms, expressions, conditions and effects.
//
// Thread rule: one parse, one object. Every function takes its text from the stream and returns false after
// reporting an error.

#include <optional>
#include <string>
#include <vector>

#include "supervisor/lisp/effect_parser.h"
#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/syntax/notation.h"

namespace stepwright::pddl {

class FormulaParser : public lisp::EffectParser<FormulaParser, Effect> {
 public:
  explicit FormulaParser(TokenStream& tokens) : EffectParser(tokens) {}

  // "a b - t c" up to, not including, the closing parenthesis. `kind` is Name or Variable.
  bool typed_list(TokenKind kind, std::vector<Typed>& list);

  // "(name ?x - t ...)": a predicate or function declaration.
  bool declaration(Symbol& symbol);

  bool formula(Formula& formula);
  bool expression(Expression& expression);

  // "(name term ...)".
  bool call(Call& call);

 private:
  friend class lisp::EffectParser<FormulaParser, Effect>;

  bool arguments(Call& call);
  bool term(Term& term);
  bool compare(Formula& formula);
  bool equality(Formula& formula);
  bool quantifier(std::vector<Typed>& variables);
  bool quantified(Formula& formula, FormulaKind kind);
  bool connective(Formula& formula, FormulaKind kind);
  bool numeric_effect(Effect& effect, ChangeKind change);
  std::optional<bool> change(Effect& effect, const std::string& head);
  bool operation(Expression& expression, const std::string& symbol);
  bool close() { return tokens_.expect(TokenKind::Close, "')'"); }
};

}  // namespace stepwright::pddl

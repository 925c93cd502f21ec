#pragma once

// The parts that domains and problems share: terms, conditions, effects and task networks.
//
// Thread rule: one parse, one object. Every function takes its text from the stream and returns false after
// reporting an error.

#include <optional>
#include <string>
#include <vector>

#include "supervisor/htn/syntax/syntax_tree.h"
#include "supervisor/lisp/effect_parser.h"

namespace stepwright::htn {

class FormulaParser : public lisp::EffectParser<FormulaParser, ParsedEffect> {
 public:
  explicit FormulaParser(lisp::TokenStream& tokens) : EffectParser(tokens) {}

  // "(name ?x - t ...)".
  bool declaration(ParsedSymbol& symbol);
  // "(?x - t ...)".
  bool parameters(std::vector<TypedName>& list);
  // "(name term ...)".
  bool call(ParsedCall& call);
  bool formula(ParsedFormula& formula);

 private:
  friend class lisp::EffectParser<FormulaParser, ParsedEffect>;

  bool term(ParsedTerm& term);
  bool arguments(ParsedCall& call);
  bool connective(ParsedFormula& formula, FormulaKind kind);
  bool quantified(ParsedFormula& formula, FormulaKind kind);
  bool equality(ParsedFormula& formula);
  bool quantifier(std::vector<TypedName>& variables) { return parameters(variables); }
  std::optional<bool> change(ParsedEffect& effect, const std::string& head);
  bool cost(ParsedEffect& effect);
  bool close() { return tokens_.expect(lisp::TokenKind::Close, "')'"); }
};

}  // namespace stepwright::htn

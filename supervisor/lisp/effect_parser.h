#pragma once

// The forms of effects that PDDL and HDDL share: conjunctions, deletions, conditions, quantifiers, and facts
// that are added. Base of a language's parser of formulas, which says what else an effect can be:
//
//   class FormulaParser : public lisp::EffectParser<FormulaParser, Effect> {
//     friend class lisp::EffectParser<FormulaParser, Effect>;
//     bool formula(Formula& formula);
//     bool call(Call& call);            // "(name term ...)"
//     bool arguments(Call& call);       // "term ...)"
//     bool quantifier(std::vector<Typed>& variables);
//     bool close();
//     std::optional<bool> change(Effect& effect, const std::string& head);  // nothing: a fact's name
//   };
//
// Thread rule: one parse, one object. `effect` takes its text from the stream and returns false after
// reporting an error.

#include <string>

#include "supervisor/lisp/token_stream.h"

namespace stepwright::lisp {

template <typename Language, typename Effect>
class EffectParser {
 public:
  bool effect(Effect& effect) {
    if (tokens_.too_deep()) return false;
    effect.at = tokens_.peek().at;
    if (!tokens_.expect(TokenKind::Open, "an effect in parentheses")) return false;
    if (tokens_.accept(TokenKind::Close)) return true;
    std::string head;
    if (!tokens_.expect_name("a predicate or an effect", head, effect.call.at)) return false;
    return body(effect, head);
  }

 protected:
  explicit EffectParser(TokenStream& tokens) : tokens_(tokens) {}

  TokenStream& tokens_;

 private:
  using Kind = decltype(Effect::kind);

  bool body(Effect& effect, const std::string& head) {
    auto& language = static_cast<Language&>(*this);
    if (head == "and") {
      while (!tokens_.at(TokenKind::Close)) {
        effect.parts.emplace_back();
        if (!this->effect(effect.parts.back())) return false;
      }
      return language.close();
    }
    if (head == "not") {
      effect.kind = Kind::Delete;
      return language.call(effect.call) && language.close();
    }
    if (head == "when") {
      effect.kind = Kind::When;
      effect.condition.resize(1);
      effect.parts.resize(1);
      return language.formula(effect.condition[0]) && this->effect(effect.parts[0]) && language.close();
    }
    if (head == "forall") {
      effect.parts.resize(1);
      if (!language.quantifier(effect.variables)) return false;
      effect.kind = effect.variables.empty() ? Kind::And : Kind::Forall;
      return this->effect(effect.parts[0]) && language.close();
    }
    if (const auto changed = language.change(effect, head)) return *changed;
    effect.kind = Kind::Add;
    effect.call.name = head;
    return language.arguments(effect.call);
  }
};

}  // namespace stepwright::lisp

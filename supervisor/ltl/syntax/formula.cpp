#include "supervisor/ltl/syntax/formula.h"

#include "supervisor/ltl/syntax/parser.h"

namespace stepwright::ltl {

namespace {

// The term of a node or of its negation, from those of its children.
class NormalForm {
 public:
  explicit NormalForm(Formula& formula) : formula_(formula), terms_(formula.terms) {}

  Term of(const SyntaxNode& node, bool positive) {
    const auto a = [&](bool same = true) { return child(node, 0, positive == same); };
    const auto b = [&](bool same = true) { return child(node, 1, positive == same); };
    switch (node.op) {
      case Operator::False:
        return positive ? kFalseTerm : kTrueTerm;
      case Operator::True:
        return positive ? kTrueTerm : kFalseTerm;
      case Operator::Name:
        return terms_.literal(node.proposition, !positive);
      case Operator::Not:
        return a(false);
      case Operator::And:
        return list(node, positive, positive);
      case Operator::Or:
        return list(node, positive, !positive);
      case Operator::Implies:
        return list_of({child(node, 0, !positive), child(node, 1, positive)}, !positive);
      case Operator::Xor:
        return differ(node, positive);
      case Operator::Iff:
        return differ(node, !positive);
      case Operator::Next:
        return terms_.next(a());
      case Operator::Eventually:
        return positive ? terms_.until(kTrueTerm, a()) : terms_.release(kFalseTerm, a());
      case Operator::Always:
        return positive ? terms_.release(kFalseTerm, a()) : terms_.until(kTrueTerm, a());
      case Operator::Until:
        return positive ? terms_.until(a(), b()) : terms_.release(a(), b());
      case Operator::Release:
        return positive ? terms_.release(a(), b()) : terms_.until(a(), b());
      case Operator::WeakUntil:  // a W b = b R (a | b); its negation !b U (!a & !b)
        return positive ? terms_.release(b(), terms_.disjunction({a(), b()}))
                        : terms_.until(b(), terms_.conjunction({a(), b()}));
      case Operator::StrongRelease:  // a M b = b U (a & b); its negation !b R (!a | !b)
        return positive ? terms_.until(b(), terms_.conjunction({a(), b()}))
                        : terms_.release(b(), terms_.disjunction({a(), b()}));
    }
    return kFalseTerm;
  }

 private:
  Term child(const SyntaxNode& node, std::size_t k, bool positive) {
    const SyntaxId id = node.children[k];
    return positive ? formula_.positive[id] : formula_.negative[id];
  }
  Term list_of(std::vector<Term> operands, bool all) {
    return all ? terms_.conjunction(std::move(operands)) : terms_.disjunction(std::move(operands));
  }
  Term list(const SyntaxNode& node, bool positive, bool all) {
    std::vector<Term> operands;
    for (std::size_t k = 0; k < node.children.size(); ++k) operands.push_back(child(node, k, positive));
    return list_of(std::move(operands), all);
  }
  Term differ(const SyntaxNode& node, bool different) {
    const Term first = terms_.conjunction({child(node, 0, true), child(node, 1, !different)});
    const Term second = terms_.conjunction({child(node, 0, false), child(node, 1, different)});
    return terms_.disjunction({first, second});
  }

  Formula& formula_;
  Terms& terms_;
};

}  // namespace

result::Result<Formula> parse_formula(std::string_view text, const std::string& file,
                                      std::vector<std::string> propositions, const TextLimits& limits) {
  auto tokens = tokenize(text, file);
  if (!tokens) return result::forward(tokens);
  auto tree = Parser(std::move(*tokens), file, std::move(propositions), limits).run();
  if (!tree) return result::forward(tree);
  Formula formula;
  formula.tree = std::move(*tree);
  NormalForm normal(formula);
  for (const SyntaxNode& node : formula.tree.nodes) {
    const Term positive = normal.of(node, true), negative = normal.of(node, false);
    formula.positive.push_back(positive);
    formula.negative.push_back(negative);
  }
  formula.root = formula.positive[formula.tree.root];
  return formula;
}

}  // namespace stepwright::ltl

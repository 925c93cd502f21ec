#include "supervisor/ltl/checker/plan_checker.h"

namespace stepwright::ltl {

// Term by term from the operands up, letter by letter from the end.
bool satisfies(const Formula& formula, const std::vector<Letter>& word) {
  const Terms& terms = formula.terms;
  const std::size_t length = word.size();
  std::vector<std::vector<bool>> holds(terms.size(), std::vector<bool>(length + 1, false));
  for (Term term = 0; term < terms.size(); ++term) {
    const auto operands = terms.operands(term);
    std::vector<bool>& here = holds[term];
    for (std::size_t i = length + 1; i-- > 0;) {
      const bool is_end = i == length;
      switch (terms.kind(term)) {
        case TermKind::False:
          break;
        case TermKind::True:
          here[i] = true;
          break;
        case TermKind::Literal:
          here[i] = !is_end && ((word[i] >> terms.proposition(term) & 1) != 0) != terms.negated(term);
          break;
        case TermKind::And:
          here[i] = true;
          for (const Term each : operands) here[i] = here[i] && holds[each][i];
          break;
        case TermKind::Or:
          for (const Term each : operands) here[i] = here[i] || holds[each][i];
          break;
        case TermKind::Next:
          here[i] = !is_end && holds[operands[0]][i + 1];
          break;
        case TermKind::Until:
          here[i] = !is_end && (holds[operands[1]][i] || (holds[operands[0]][i] && here[i + 1]));
          break;
        case TermKind::Release:
          here[i] = is_end || (holds[operands[1]][i] && (holds[operands[0]][i] || here[i + 1]));
          break;
      }
    }
  }
  return holds[formula.root][0];
}

}  // namespace stepwright::ltl

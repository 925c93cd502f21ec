#include "supervisor/pddl/semantics/stratify.h"

#include <algorithm>

namespace stepwright::pddl {
namespace {

// A derived predicate that the body of another reads.
struct Use {
  int head = 0;
  int body = 0;
  bool negated = false;
  Place at;
  std::string name;
};

class Stratifier {
 public:
  Stratifier(Definition& definition, Reporter& reporter) : definition_(definition), reporter_(reporter) {}

  void run() {
    for (const Axiom& axiom : definition_.axioms) visit(axiom.predicate, axiom.body, false);
    spread_changes();
    if (!find_cycles()) return;
    layers();
    std::stable_sort(definition_.axioms.begin(), definition_.axioms.end(),
                     [&](const Axiom& a, const Axiom& b) { return layer(a) < layer(b); });
  }

 private:
  Symbol& predicate(int id) { return definition_.predicates[static_cast<std::size_t>(id)]; }
  int layer(const Axiom& axiom) { return predicate(axiom.predicate).layer; }

  void visit(int head, const Expression& expression) {
    if (expression.kind == NumericKind::Fluent &&
        definition_.functions[static_cast<std::size_t>(expression.call.symbol)].changes) {
      predicate(head).changes = true;
    }
    for (const Expression& operand : expression.operands) visit(head, operand);
  }

  void visit(int head, const Formula& formula, bool negated) {
    if (formula.kind == FormulaKind::Atom) {
      const Symbol& body = predicate(formula.call.symbol);
      if (body.derived) uses_.push_back({head, formula.call.symbol, negated, formula.call.at, body.name});
      if (!body.derived && body.changes) predicate(head).changes = true;
    }
    for (const Expression& side : formula.sides) visit(head, side);
    for (std::size_t i = 0; i < formula.parts.size(); ++i) {
      const bool flip = formula.kind == FormulaKind::Not || (formula.kind == FormulaKind::Imply && i == 0);
      visit(head, formula.parts[i], negated != flip);
    }
  }

  void spread_changes() {
    for (bool changed = true; changed;) {
      changed = false;
      for (const Use& use : uses_) {
        if (!predicate(use.body).changes || predicate(use.head).changes) continue;
        predicate(use.head).changes = changed = true;
      }
    }
  }

  // The predicates that `start` depends on.
  std::vector<bool> dependencies(int start) const {
    std::vector<bool> found(definition_.predicates.size(), false);
    std::vector<int> open{start};
    while (!open.empty()) {
      const int head = open.back();
      open.pop_back();
      for (const Use& use : uses_) {
        if (use.head != head || found[static_cast<std::size_t>(use.body)]) continue;
        found[static_cast<std::size_t>(use.body)] = true;
        open.push_back(use.body);
      }
    }
    return found;
  }

  bool find_cycles() {
    bool good = true;
    for (const Use& use : uses_) {
      if (!use.negated) continue;
      const bool cycle = use.body == use.head || dependencies(use.body)[static_cast<std::size_t>(use.head)];
      if (!cycle) continue;
      good = false;
      reporter_.error("P0116", use.at, "'" + use.name + "' depends on its own negation",
                      "a derived predicate may be negated only in rules that it does not depend on");
    }
    return good;
  }

  void layers() {
    for (bool changed = true; changed;) {
      changed = false;
      for (const Use& use : uses_) {
        const int least = predicate(use.body).layer + (use.negated ? 1 : 0);
        if (predicate(use.head).layer >= least) continue;
        predicate(use.head).layer = least;
        changed = true;
      }
    }
  }

  Definition& definition_;
  Reporter& reporter_;
  std::vector<Use> uses_;
};

}  // namespace

void stratify(Definition& definition, Reporter& reporter) {
  Stratifier(definition, reporter).run();
}

}  // namespace stepwright::pddl

#include "supervisor/htn/search/method_tests.h"

#include <algorithm>
#include <bit>

namespace stepwright::htn {
namespace {

constexpr std::size_t kMostColumns = 64;  // of an atom; those beyond are compared one by one

bool is_literal(const Condition& condition) {
  const Condition& atom = condition.kind == ConditionKind::Not ? condition.parts[0] : condition;
  return atom.kind == ConditionKind::Atom || atom.kind == ConditionKind::Equal ||
         atom.kind == ConditionKind::OfType;
}

class Preparation {
 public:
  Preparation(const PlanningTask& task, const Method& method) : task_(task), method_(method) {
    bound_.assign(method.parameters.size(), false);
  }

  MethodTests run() {
    all_ = method_.condition.parts;
    for (std::size_t i = 0; i < method_.subtasks.size(); ++i)
      if (method_.subtasks[i].primitive) foresee(method_.subtasks[i], i == 0);
    for (const Term term : method_.task_terms)
      if (term >= 0) bound_[static_cast<std::size_t>(term)] = true;
    used_.assign(all_.size(), false);
    MethodTests tests;
    tests.first = ready();
    for (const Variable& variable : method_.parameters) {
      if (is_bound(variable.slot)) continue;
      OpenVariable open;
      open.slot = variable.slot;
      open.type = variable.type;
      choose_source(open);
      bound_[static_cast<std::size_t>(variable.slot)] = true;
      open.tests = ready();
      tests.open.push_back(std::move(open));
    }
    return tests;
  }

 private:
  bool is_bound(Term term) const { return term < 0 || bound_[static_cast<std::size_t>(term)]; }

  // Whether all parameters that the condition reads are bound; quantifiers have slots of their own.
  bool can_be_tested(const Condition& condition) const {
    const auto known = [&](Term term) { return term >= static_cast<Term>(bound_.size()) || is_bound(term); };
    return std::ranges::all_of(condition.terms, known) &&
           std::ranges::all_of(condition.parts, [&](const Condition& part) { return can_be_tested(part); });
  }

  // What is not tested yet, and can be now.
  std::vector<Condition> ready() {
    std::vector<Condition> tests;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (used_[i] || !can_be_tested(all_[i])) continue;
      used_[i] = true;
      tests.push_back(all_[i]);
    }
    // What costs least comes first.
    std::ranges::stable_sort(
        tests, [](const Condition& a, const Condition& b) { return is_literal(a) && !is_literal(b); });
    return tests;
  }

  // Conditions of an action, with the subtask's terms for its parameters.
  void foresee(const Subtask& subtask, bool first) {
    const Action& action = task_.actions[static_cast<std::size_t>(subtask.symbol)];
    for (const Condition& part : action.condition.parts) {
      if (!is_literal(part)) continue;
      const Condition& atom = part.kind == ConditionKind::Not ? part.parts[0] : part;
      const bool lasting = atom.kind != ConditionKind::Atom ||
                           !task_.predicates[static_cast<std::size_t>(atom.symbol)].changes;
      if (first || lasting) all_.push_back(substituted(part, subtask.terms));
    }
  }

  static Condition substituted(const Condition& condition, const std::vector<Term>& terms) {
    Condition copy = condition;
    for (Term& term : copy.terms)
      if (term >= 0) term = terms[static_cast<std::size_t>(term)];
    for (Condition& part : copy.parts) part = substituted(part, terms);
    return copy;
  }

  // The atom with the variable of which most columns are bound by then.
  void choose_source(OpenVariable& open) const {
    int most = -1;
    for (const Condition& atom : all_) {
      const auto column = std::ranges::find(atom.terms, open.slot);
      if (atom.kind != ConditionKind::Atom || column == atom.terms.end()) continue;
      std::uint64_t columns = 0;
      std::vector<bool> known;
      for (std::size_t i = 0; i < atom.terms.size(); ++i) {
        const Term term = atom.terms[i];
        known.push_back(is_bound(term));
        if (known.back() && i < kMostColumns) columns |= std::uint64_t{1} << i;
      }
      const int count = std::popcount(columns);
      if (count <= most) continue;
      most = count;
      open.predicate = atom.symbol;
      open.terms = atom.terms;
      open.bound = known;
      open.columns = columns;
      open.column = static_cast<std::size_t>(column - atom.terms.begin());
    }
  }

  const PlanningTask& task_;
  const Method& method_;
  std::vector<bool> bound_;  // of the parameters
  std::vector<Condition> all_;
  std::vector<bool> used_;
};

}  // namespace

MethodTests tests_of(const PlanningTask& task, const Method& method) {
  return Preparation(task, method).run();
}

}  // namespace stepwright::htn

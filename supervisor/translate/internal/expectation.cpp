#include "supervisor/translate/internal/expectation.h"

#include <algorithm>

namespace stepwright::translate::internal {
namespace {

// together[i][j]: the order lets actions i and j run at the same time.
std::vector<std::vector<bool>> simultaneous(std::size_t size, const std::vector<model::Ordering>& orderings) {
  std::vector<std::vector<bool>> before(size, std::vector<bool>(size, false));
  for (std::size_t n = orderings.size(); n-- > 0;) {  // sorted; every edge leads to a larger index
    const model::Ordering& edge = orderings[n];
    before[edge.before][edge.after] = true;
    for (std::size_t k = 0; k < size; ++k) {
      if (before[edge.after][k]) before[edge.before][k] = true;
    }
  }
  std::vector<std::vector<bool>> together(size, std::vector<bool>(size, true));
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) together[i][j] = i != j && !before[i][j] && !before[j][i];
  }
  return together;
}

void add_groups(const Binding& binding, std::set<std::string>& atoms) {
  for (const OneOf& group : binding.one_of) {
    const bool moved = std::any_of(group.facts.begin(), group.facts.end(),
                                   [&](const std::string& fact) { return atoms.contains(fact); });
    if (moved) atoms.insert(group.facts.begin(), group.facts.end());
  }
}

}  // namespace

std::vector<Expectation> expectations(const Translation& translation, const model::PlannedRun& run,
                                      const Binding& binding) {
  const std::size_t size = run.actions.size();
  const auto together = simultaneous(size, translation.orderings);
  std::vector<Expectation> all(size);
  for (std::size_t action = 0; action < size; ++action) {
    Expectation& expected = all[action];
    expected.own = changed_atoms(run.actions[action]);
    expected.during = translation.initial;
    for (std::size_t i = 0; i < size; ++i) {
      const bool beside = together[action][i];
      if (beside) expected.elsewhere.merge(changed_atoms(run.actions[i]));
      if (i < action && !beside) apply(translation.changes[i], expected.during);
    }
    expected.after = expected.during;
    apply(translation.changes[action], expected.after);
    add_groups(binding, expected.own);
    add_groups(binding, expected.elsewhere);
  }
  return all;
}

}  // namespace stepwright::translate::internal

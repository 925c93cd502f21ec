#include "supervisor/fleet/schedule/internal/clauses.h"

#include <algorithm>
#include <utility>

namespace stepwright::fleet::internal {

ClauseId Clauses::add(std::vector<Literal> literals, std::uint32_t levels) {
  clauses_.push_back({std::move(literals), levels});
  const auto id = static_cast<ClauseId>(clauses_.size() - 1);
  watch(id);
  return id;
}

void Clauses::watch(ClauseId id) {
  const std::vector<Literal>& literals = clauses_[id].literals;
  watches_[literals[0].value].push_back({id, literals[1]});
  watches_[literals[1].value].push_back({id, literals[0]});
}

void Clauses::reduce() {
  std::vector<std::uint32_t> levels;
  for (const Clause& clause : clauses_) levels.push_back(clause.levels);
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::ranges::nth_element(levels, middle);
  const std::uint32_t most = std::max(2U, *middle);
  std::erase_if(clauses_, [&](const Clause& clause) { return clause.levels > most; });
  for (auto& watches : watches_) watches.clear();
  for (ClauseId id = 0; id < clauses_.size(); ++id) watch(id);
}

}  // namespace stepwright::fleet::internal

#include "supervisor/ltl/monitor/step_table.h"

#include <algorithm>
#include <map>
#include <utility>

namespace stepwright::ltl {

namespace {

constexpr std::uint32_t kWidth = 4;

// What is left of a guard when the propositions below `end` are known; bit 0 of `values` is that of `begin`.
Guard after(const Guards& guards, Guard at, std::uint32_t begin, std::uint32_t end, std::uint32_t values) {
  while (!is_state(at) && guards.nodes()[at].proposition < end) {
    const GuardNode& node = guards.nodes()[at];
    at = (values >> (node.proposition - begin) & 1) != 0 ? node.high : node.low;
  }
  return at;
}

}  // namespace

std::optional<StepTable> step_table(const Automaton& automaton, std::size_t most) {
  const auto propositions = static_cast<std::uint32_t>(automaton.propositions.size());
  StepTable table;
  table.looks = std::max(1u, (propositions + kWidth - 1) / kWidth);
  table.width = (propositions + table.looks - 1) / table.looks;
  const std::size_t row = std::size_t{1} << table.width;

  // A row is a guard and how many looks have been taken.
  using Row = std::pair<Guard, std::uint32_t>;
  std::vector<Row> rows;
  for (const Guard each : automaton.edges) rows.emplace_back(each, 0);
  std::map<Row, std::uint32_t> numbers;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows.size() * row > most) return std::nullopt;
    const auto [guard, taken] = rows[k];
    const std::uint32_t begin = taken * table.width;
    for (std::uint32_t values = 0; values < row; ++values) {
      const Guard left = after(automaton.guards, guard, begin, begin + table.width, values);
      if (taken + 1 == table.looks) {
        table.entries.push_back(state_of(left));
        continue;
      }
      const auto [known, added] =
          numbers.emplace(Row{left, taken + 1}, static_cast<std::uint32_t>(rows.size()));
      if (added) rows.push_back(known->first);
      table.entries.push_back(known->second);
    }
  }
  return table;
}

}  // namespace stepwright::ltl

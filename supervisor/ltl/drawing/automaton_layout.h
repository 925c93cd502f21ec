#pragma once

// Where the states of an automaton stand in a picture: in columns by the longest way that leads to them
// without going round, so that arrows lead from left to right; what is decided in a column of its own behind
// all others.
//
// Thread rule: pure function. Example:
//   const auto places = lay_out({.after = {{1, 2}, {2}, {}}, .decided = {0, 0, 1}});
//   places[2].column;   // 2

#include <cstdint>
#include <vector>

namespace stepwright::ltl {

struct AutomatonGraph {
  std::vector<std::vector<std::uint32_t>> after;  // of each state those that it leads to, itself perhaps
  std::vector<std::uint8_t> decided;  // 0: it is not; the greater, the lower in the column of those that are
  std::uint32_t initial = 0;
  std::vector<std::uint32_t> first_row{};  // states with the topmost row to themselves; empty: none have it
};

struct StatePlace {
  std::uint32_t column = 0;
  std::uint32_t row = 0;  // within the column, from the top
  bool reached = false;   // from the initial state; places of others mean nothing
};

std::vector<StatePlace> lay_out(const AutomatonGraph& graph);

}  // namespace stepwright::ltl

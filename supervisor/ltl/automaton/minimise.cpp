#include <deque>
#include <map>
#include <tuple>
#include <utility>

#include "supervisor/ltl/automaton/automaton.h"

namespace stepwright::ltl {

namespace {

using Distances = std::vector<std::uint32_t>;

// Transitions from each state to the nearest one of a verdict; kNever where there is none.
Distances distances_to(const Automaton& automaton, Verdict verdict) {
  std::vector<std::vector<std::uint32_t>> before(automaton.size());
  std::deque<std::uint32_t> open;
  Distances distances(automaton.size(), Automaton::kNever);
  for (std::uint32_t state = 0; state < automaton.size(); ++state) {
    std::vector<std::uint32_t> after;
    automaton.guards.collect(automaton.edges[state], after);
    for (const std::uint32_t each : after) before[each].push_back(state);
    if (automaton.verdicts[state] != verdict) continue;
    distances[state] = 0;
    open.push_back(state);
  }
  while (!open.empty()) {
    const std::uint32_t state = open.front();
    open.pop_front();
    for (const std::uint32_t each : before[state]) {
      if (distances[each] != Automaton::kNever || automaton.verdicts[each] != Verdict::Undecided) continue;
      distances[each] = distances[state] + 1;
      open.push_back(each);
    }
  }
  return distances;
}

// Verdicts with their distances: what is the same of all states of a class, and a good beginning. Long chains
// of states need no more rounds than this.
std::vector<std::uint32_t> first_classes(const Automaton& automaton) {
  const Distances good = distances_to(automaton, Verdict::True),
                  bad = distances_to(automaton, Verdict::False);
  std::map<std::tuple<Verdict, std::uint32_t, std::uint32_t>, std::uint32_t> numbers;
  std::vector<std::uint32_t> classes;
  for (std::size_t k = 0; k < automaton.size(); ++k) {
    const auto next = static_cast<std::uint32_t>(numbers.size());
    classes.push_back(
        numbers.emplace(std::tuple{automaton.verdicts[k], good[k], bad[k]}, next).first->second);
  }
  return classes;
}

// E. Moore's refinement: two states stay together while their edges lead to the same classes. Edges are
// compared as shared diagrams, so a round costs as much as there are nodes, not as there are letters.
std::vector<std::uint32_t> classes_of(const Automaton& automaton) {
  std::vector<std::uint32_t> classes = first_classes(automaton);
  for (std::size_t before = 0;;) {
    Guards merged;
    GuardRewriter rewrite(automaton.guards, merged, classes);
    std::map<std::pair<std::uint32_t, Guard>, std::uint32_t> numbers;
    std::vector<std::uint32_t> finer(classes.size());
    for (std::size_t k = 0; k < classes.size(); ++k) {
      // What is decided stays decided, whatever its edges say.
      const bool decided = automaton.verdicts[k] != Verdict::Undecided;
      const Guard edges = decided ? guard_of_state(classes[k]) : rewrite(automaton.edges[k]);
      finer[k] = numbers.emplace(std::pair{classes[k], edges}, static_cast<std::uint32_t>(numbers.size()))
                     .first->second;
    }
    classes = std::move(finer);
    if (numbers.size() == before) return classes;
    before = numbers.size();
  }
}

}  // namespace

Automaton minimised(const Automaton& automaton) {
  const std::vector<std::uint32_t> classes = classes_of(automaton);
  constexpr std::uint32_t kUnmet = 0xFFFFFFFF;
  std::vector<std::uint32_t> number_of_class(automaton.size(), kUnmet), members, numbers(automaton.size(), 0);
  const auto meet = [&](std::uint32_t state) {
    if (number_of_class[classes[state]] != kUnmet) return;
    number_of_class[classes[state]] = static_cast<std::uint32_t>(members.size());
    members.push_back(state);
  };
  // The order of a search from the initial state over reduced guards: the same for every automaton of a
  // language.
  Guards reduced;
  GuardRewriter rewrite(automaton.guards, reduced, classes);
  std::vector<std::uint32_t> member_of_class(automaton.size(), 0);
  for (std::uint32_t k = 0; k < automaton.size(); ++k) member_of_class[classes[k]] = k;
  meet(automaton.initial);
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (automaton.verdicts[members[k]] != Verdict::Undecided) continue;
    std::vector<std::uint32_t> after;
    reduced.collect(rewrite(automaton.edges[members[k]]), after);
    for (const std::uint32_t each : after) meet(member_of_class[each]);
  }
  for (std::uint32_t k = 0; k < automaton.size(); ++k)
    numbers[k] = number_of_class[classes[k]] == kUnmet ? 0 : number_of_class[classes[k]];

  Automaton small;
  small.propositions = automaton.propositions;
  GuardRewriter renumber(automaton.guards, small.guards, numbers);
  for (std::uint32_t k = 0; k < members.size(); ++k) {
    small.verdicts.push_back(automaton.verdicts[members[k]]);
    small.edges.push_back(small.verdicts[k] == Verdict::Undecided ? renumber(automaton.edges[members[k]])
                                                                  : guard_of_state(k));
  }
  small.distance = distances_to(small, Verdict::True);
  return small;
}

}  // namespace stepwright::ltl

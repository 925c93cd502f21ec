#pragma once

// How far it is from each region of a floor, in each state of a task's automaton, to the end of the task: the
// cheapest way through the product of both (E. Plaku 2012, section 3.3), for all of its states at once. A way
// leads from middle to middle of regions through the middles of the sides between them.
//
// The product's state (region, z): the point is there and the automaton has read its label. A word is one of
// label changes: within regions of one label nothing is read.
//
// Immutable; any thread may read. Map and automaton must outlive it. Costs O(s log s) for s regions times
// states. Example:
//   const Guide guide(*map, task->automaton);
//   const std::uint32_t z = guide.start(here);
//   if (guide.to_go_m(here, z) == Guide::kNever) ...                  // why_impossible() says why
//   for (const Stage& stage : guide.way(here, z)) ...                 // region by region, to acceptance

#include <cstdint>
#include <limits>
#include <vector>

#include "supervisor/ltl/automaton/automaton.h"
#include "supervisor/ltl/regions/region_map.h"

namespace stepwright::ltl {

struct Stage {
  std::uint32_t region = 0;
  std::uint32_t state = 0;

  friend bool operator==(const Stage&, const Stage&) = default;
};

class Guide {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  // Bit k of a letter and of a label are the same proposition.
  Guide(const RegionMap& map, const Automaton& automaton);

  // The automaton's state of a word that begins there.
  std::uint32_t start(std::uint32_t region) const { return after(automaton_.initial, region); }
  // And of one that goes on from `from` to a neighbour of it.
  std::uint32_t after(std::uint32_t state, std::uint32_t from, std::uint32_t to) const;

  double to_go_m(std::uint32_t region, std::uint32_t state) const { return to_go_m_[index(region, state)]; }
  // From this state to the first accepting one, both included; empty if there is no way.
  std::vector<Stage> way(std::uint32_t region, std::uint32_t state) const;

  // From middle to middle of two neighbours over the side `k` of the first one.
  double side_m(std::uint32_t region, std::size_t k) const;

 private:
  std::size_t index(std::uint32_t region, std::uint32_t state) const {
    return static_cast<std::size_t>(region) * automaton_.size() + state;
  }
  std::uint32_t after(std::uint32_t state, std::uint32_t region) const {
    return next_[label_of_[region] * automaton_.size() + state];
  }
  void number_labels();
  void find_ways();

  const RegionMap& map_;
  const Automaton& automaton_;
  std::vector<std::size_t> label_of_;   // of each region: which of the distinct labels
  std::vector<Label> labels_;           // those
  std::vector<std::uint32_t> next_;     // of each label and state: the state after it
  std::vector<std::uint32_t> first_;    // of each label and state: its predecessors by that label among
  std::vector<std::uint32_t> before_;   // these
  std::vector<double> to_go_m_;         // of the product's states
  std::vector<std::size_t> successor_;  // on the cheapest way
};

}  // namespace stepwright::ltl

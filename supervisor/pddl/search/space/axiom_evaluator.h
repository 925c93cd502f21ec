#pragma once

// The derived facts of packed states: layer by layer, each to its fixpoint. An axiom is looked at again only
// when a fact of its own layer that it reads has just been derived.
//
// Thread rule: immutable. Invariant: only the bits of derived
// facts are written, and the result depends on the other bits and the variables alone.
//
//   AxiomEvaluator axioms(task);
//   axioms.derive(state, [&](const Condition& body) { return space.holds(body, state); });

#include <cstddef>
#include <cstdint>
#include <vector>

#include "supervisor/pddl/ground_task/ground_task.h"
#include "supervisor/pddl/search/space/packed_bits.h"

namespace stepwright::pddl {

class AxiomEvaluator {
 public:
  explicit AxiomEvaluator(const GroundTask& task);

  // `holds`: whether a condition holds in `state` as it is at the time of the call.
  template <typename Holds>
  void derive(Word* state, const Holds& holds) const;

 private:
  struct Layer {
    std::size_t first = 0, last = 0;  // axioms
  };

  void clear(Word* state) const;

  const std::vector<GroundAxiom>& axioms_;
  int first_derived_;
  int facts_;
  std::vector<Layer> layers_;
  std::vector<std::vector<int>> readers_;  // axioms of a derived fact's layer that read it
};

template <typename Holds>
void AxiomEvaluator::derive(Word* state, const Holds& holds) const {
  clear(state);
  std::vector<int> open;
  for (const Layer& layer : layers_) {
    const auto look_at = [&](std::size_t axiom) {
      const int head = axioms_[axiom].fact;
      if (bit(state, head) || !holds(axioms_[axiom].body)) return;
      state[head >> 6] |= Word{1} << (head & 63);
      open.push_back(head);
    };
    for (std::size_t i = layer.first; i < layer.last; ++i) look_at(i);
    while (!open.empty()) {
      const int derived = open.back();
      open.pop_back();
      for (const int i : readers_[static_cast<std::size_t>(derived - first_derived_)]) {
        look_at(static_cast<std::size_t>(i));
      }
    }
  }
}

}  // namespace stepwright::pddl

#pragma once

// Lifted candidates for mutual exclusion: "for every x: of (at x ?) and (in x ?) at most one holds" is a
// candidate with one parameter and two parts (Helmert 2009, "Concise finite-domain representations for PDDL
// planning tasks", section 5). An instance is what one choice of objects for the parameters gives.
//
// Thread rule: plain values, pure functions.

#include <compare>
#include <vector>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

// A predicate of the candidate. Every argument is one of the parameters, but for at most one that is counted.
struct InvariantPart {
  int predicate = 0;
  std::vector<int> positions;  // the argument that each parameter takes
  int counted = -1;            // the argument left over, or -1
  friend auto operator<=>(const InvariantPart&, const InvariantPart&) = default;
};

// Parts by predicate, no predicate twice; the first one takes the parameters in their order, so that equal
// candidates are equal values.
struct InvariantCandidate {
  std::vector<InvariantPart> parts;
  friend auto operator<=>(const InvariantCandidate&, const InvariantCandidate&) = default;

  const InvariantPart* part_of(int predicate) const;
};

// The candidates of one part: for every predicate that actions change, every choice of the counted argument.
std::vector<InvariantCandidate> simplest_candidates(const Definition& definition);

// The candidates with one part more, such that the instance with these objects covers the fact too.
std::vector<InvariantCandidate> refine(const InvariantCandidate& candidate, const std::vector<int>& objects,
                                       const Atom& fact);

// The objects of the instance that the fact belongs to.
std::vector<int> instance_of(const InvariantPart& part, const Atom& fact);

}  // namespace stepwright::pddl

#pragma once

// Predicates that are evaluated, and changed, outside of the symbolic state (Dornhege, Eyerich, Keller,
// Trueg, Brenner, Nebel 2009, "Semantic attachments for domain-independent planning systems"; for geometry as
// in Karlsson, Bidot, Lagriffoul, Saffiotti 2012): the states of somebody else, one for every action of the
// present prefix.
//
// Thread rule: called by the thread of the search only.
// The search keeps its side of this: `push` before the conditions and effects of an action, in the order of
// the domain's text; `pop` for each push, the last one first; no condition is asked in any other state than
// that of the present prefix.
//
//   class Geometry : public SemanticAttachment { ... };
//   Search search(task, options, &geometry);

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "supervisor/htn/search/fingerprint.h"

namespace stepwright::htn {

// An action, or a literal of an external predicate: numbers of the PlanningTask. The span is valid during the
// call.
struct ExternalCall {
  int symbol = 0;
  std::span<const int> objects;
};

// Why a literal does not hold, or an effect cannot be had, after the present prefix of n actions (of an
// action's own conditions and effects: the n before it).
struct Refusal {
  // So many actions may stay: no plan begins with the keep + 1 first ones, of which the refused one is the
  // last. n: it is this action alone that cannot follow; fewer: the cause is an earlier choice, and the
  // search goes back there at once.
  std::size_t keep = 0;
  // False: it was not found within a budget. Such plans are left out as well, but that there are no others
  // is no proof that there is no plan.
  bool proven = true;
  std::string reason;
};

class SemanticAttachment {
 public:
  virtual ~SemanticAttachment() = default;

  // The action is about to follow the prefix: its state begins as that of the prefix.
  virtual void push(const ExternalCall& action) = 0;
  // The last action is taken back.
  virtual void pop() = 0;

  // Whether the atom has this truth in the present state; nothing if so. May complete the state (choose a
  // grasp, find a path), also those of earlier actions, as long as all that was asked before keeps its
  // answer.
  virtual std::optional<Refusal> require(const ExternalCall& atom, bool wanted) = 0;

  // Gives the atom this truth in the present state; nothing if that could be done.
  virtual std::optional<Refusal> change(const ExternalCall& atom, bool value) = 0;

  // States with equal fingerprints answer alike, whatever follows: with it the search does not come to one
  // node twice. Nothing: no two states can be compared; then a network that comes back in the same symbolic
  // state on one way is cut off, which counts as a budget.
  virtual std::optional<Fingerprint> fingerprint() const { return std::nullopt; }
};

}  // namespace stepwright::htn

#pragma once

// The geometry of a prefix as far as intervals know it: a literal is refused where the prefix with this
// action is refuted, with a proof, and holds otherwise. Whether a whole plan can be done is asked later
// (sequence_solver.h).
//
// Thread rule: that of SemanticAttachment. Grounding and model outlive it.

#include <optional>
#include <vector>

#include "supervisor/htn/search/semantic_attachment.h"
#include "supervisor/tamp/intervals/network/network.h"
#include "supervisor/tamp/planner/interval_model.h"
#include "supervisor/tamp/predicates/grounding.h"

namespace stepwright::tamp::planner {

class IntervalGuard : public htn::SemanticAttachment {
 public:
  IntervalGuard(const predicates::Grounding& grounding, const IntervalModel& model)
      : grounding_(&grounding), model_(&model), network_(model.cell()) {}

  void push(const htn::ExternalCall& action) override;
  void pop() override;
  std::optional<htn::Refusal> require(const htn::ExternalCall& atom, bool wanted) override;
  std::optional<htn::Refusal> change(const htn::ExternalCall& atom, bool value) override;
  // Of the actions so far: equal ones have equal constraints.
  std::optional<htn::Fingerprint> fingerprint() const override { return prints_.back(); }

  std::size_t refuted() const { return refuted_; }
  // The sequence that was refuted first, with its last action: for words about why there is no plan.
  const std::vector<Action>& first_refuted() const { return first_refuted_; }

 private:
  bool is_held(std::size_t object) const;

  const predicates::Grounding* grounding_;
  const IntervalModel* model_;
  Network network_;
  std::vector<bool> pushed_;  // of each action: to the network
  std::vector<htn::Fingerprint> prints_{htn::Fingerprint{}};
  std::size_t refuted_ = 0;
  std::vector<Action> first_refuted_;
};

}  // namespace stepwright::tamp::planner

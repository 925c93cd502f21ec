#include "supervisor/tamp/intervals/cause/conflict_set.h"

#include <algorithm>

#include "supervisor/tamp/intervals/cause/witness.h"

namespace stepwright::tamp {
namespace {

// What a certificate rests upon; all that is not named there may go at once.
std::vector<bool> not_used(const Network& network) {
  std::vector<bool> unused(network.constraints().size(), true);
  for (const Step& step : network.certificate().steps) {
    if (step.kind == StepKind::Given) unused[step.subject] = false;
    if (step.kind == StepKind::Row) unused[network.rows()[step.subject].constraint] = false;
    if (step.kind != StepKind::Spot) continue;
    for (std::uint32_t v = network.last_visit(step.subject); v != Network::kNone;
         v = network.visit_before(v)) {
      unused[network.visits()[v].constraint] = false;
    }
  }
  for (std::size_t r = 0; r < network.certificate().multipliers.size(); ++r)
    if (network.certificate().multipliers[r] > 0.0) unused[network.rows()[r].constraint] = false;
  // What ties places together has no step of its own.
  for (std::size_t k = 0; k < unused.size(); ++k) {
    const Constraint& each = network.constraints()[k];
    const bool ties = each.kind == ConstraintKind::Transfer || each.kind == ConstraintKind::Stack;
    if (ties) unused[k] = false;
  }
  return unused;
}

// What people change last is tried first, so that what they can change stays in the set.
int rank_of(ConstraintKind kind) {
  switch (kind) {
    case ConstraintKind::Transfer:
      return 0;
    case ConstraintKind::Stack:
      return 1;
    case ConstraintKind::Reach:
      return 2;
    case ConstraintKind::GraspAngles:
      return 3;
    case ConstraintKind::StartAngle:
      return 4;
    case ConstraintKind::StartPosition:
      return 5;
    case ConstraintKind::StartHeight:
      return 6;
    case ConstraintKind::Beyond:
      return 7;
    case ConstraintKind::RegionArea:
      return 8;
    case ConstraintKind::FinalAngle:
      return 9;
    case ConstraintKind::RegionHeight:
      return 10;
  }
  return 11;
}

}  // namespace

std::optional<ConflictSet> conflict_of(const WorkCell& cell, std::span<const Action> sequence,
                                       std::size_t most_nodes) {
  Network whole(cell);
  for (const Action& action : sequence) whole.push(action);
  const std::vector<Constraint> constraints(whole.constraints().begin(), whole.constraints().end());
  const auto without = [&](const std::vector<bool>& dropped) {
    return solve(cell, sequence, {.dropped = dropped}, most_nodes).answer;
  };
  std::vector<bool> dropped(constraints.size(), false);
  if (whole.refuted()) {
    std::vector<bool> unused = not_used(whole);
    if (without(unused) == Answer::Infeasible) dropped = std::move(unused);
  } else if (without(dropped) != Answer::Infeasible) {
    return std::nullopt;
  }
  std::vector<ConstraintId> order;
  for (ConstraintId k = 0; k < constraints.size(); ++k)
    if (!dropped[k]) order.push_back(k);
  std::ranges::stable_sort(order, {}, [&](ConstraintId k) { return rank_of(constraints[k].kind); });
  ConflictSet set{{}, {}, true};
  for (const ConstraintId k : order) {
    dropped[k] = true;
    const Answer answer = without(dropped);
    if (answer == Answer::Infeasible) continue;
    set.irreducible = set.irreducible && answer == Answer::Feasible;
    dropped[k] = false;
  }
  for (ConstraintId k = 0; k < constraints.size(); ++k) {
    if (dropped[k]) continue;
    set.ids.push_back(k);
    set.constraints.push_back(constraints[k]);
  }
  return set;
}

}  // namespace stepwright::tamp

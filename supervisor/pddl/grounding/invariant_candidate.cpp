#include "supervisor/pddl/grounding/invariant_candidate.h"

#include <algorithm>
#include <numeric>

namespace stepwright::pddl {
namespace {

InvariantPart first_part(int predicate, int arity, int counted) {
  InvariantPart part{predicate, {}, counted};
  for (int i = 0; i < arity; ++i) {
    if (i != counted) part.positions.push_back(i);
  }
  return part;
}

// Renumbers the parameters in the order of the first part's arguments.
InvariantCandidate canonical(InvariantCandidate candidate) {
  std::sort(candidate.parts.begin(), candidate.parts.end());
  std::vector<std::size_t> order(candidate.parts.front().positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::vector<int> first = candidate.parts.front().positions;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return first[a] < first[b]; });
  for (InvariantPart& part : candidate.parts) {
    const std::vector<int> before = part.positions;
    for (std::size_t i = 0; i < order.size(); ++i) part.positions[i] = before[order[i]];
  }
  return candidate;
}

// Tries every argument of the fact that has the object of the next parameter.
void assign(const std::vector<int>& objects, const Atom& fact, InvariantPart& part, std::vector<bool>& used,
            std::vector<InvariantPart>& found) {
  if (part.positions.size() == objects.size()) {
    const auto left = std::find(used.begin(), used.end(), false);
    part.counted = left == used.end() ? -1 : static_cast<int>(left - used.begin());
    found.push_back(part);
    return;
  }
  const int object = objects[part.positions.size()];
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] || fact.arguments[i] != object) continue;
    used[i] = true;
    part.positions.push_back(static_cast<int>(i));
    assign(objects, fact, part, used, found);
    part.positions.pop_back();
    used[i] = false;
  }
}

}  // namespace

const InvariantPart* InvariantCandidate::part_of(int predicate) const {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const InvariantPart& part) { return part.predicate == predicate; });
  return found == parts.end() ? nullptr : &*found;
}

std::vector<InvariantCandidate> simplest_candidates(const Definition& definition) {
  std::vector<InvariantCandidate> candidates;
  for (std::size_t p = 0; p < definition.predicates.size(); ++p) {
    const Symbol& symbol = definition.predicates[p];
    if (!symbol.changes || symbol.derived) continue;
    const int arity = static_cast<int>(symbol.parameters.size());
    for (int counted = -1; counted < arity; ++counted) {
      candidates.push_back({{first_part(static_cast<int>(p), arity, counted)}});
    }
  }
  return candidates;
}

std::vector<InvariantCandidate> refine(const InvariantCandidate& candidate, const std::vector<int>& objects,
                                       const Atom& fact) {
  std::vector<InvariantCandidate> refined;
  const std::size_t arity = fact.arguments.size();
  if (candidate.part_of(fact.symbol) != nullptr) return refined;
  if (arity != objects.size() && arity != objects.size() + 1) return refined;
  std::vector<InvariantPart> parts;
  InvariantPart part{fact.symbol, {}, -1};
  std::vector<bool> used(arity, false);
  assign(objects, fact, part, used, parts);
  for (InvariantPart& added : parts) {
    InvariantCandidate larger = candidate;
    larger.parts.push_back(std::move(added));
    refined.push_back(canonical(std::move(larger)));
  }
  return refined;
}

std::vector<int> instance_of(const InvariantPart& part, const Atom& fact) {
  std::vector<int> objects;
  objects.reserve(part.positions.size());
  for (const int position : part.positions) {
    objects.push_back(fact.arguments[static_cast<std::size_t>(position)]);
  }
  return objects;
}

}  // namespace stepwright::pddl

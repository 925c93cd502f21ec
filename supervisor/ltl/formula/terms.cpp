#include "supervisor/ltl/formula/terms.h"

#include <algorithm>

namespace stepwright::ltl {

namespace {

std::size_t mixed(std::size_t hash, std::size_t value) {
  return (hash ^ value) * 0x9E3779B97F4A7C15u + (hash >> 29);
}

}  // namespace

Terms::Terms() {
  nodes_.resize(2);
  nodes_[kTrueTerm].kind = TermKind::True;
  duals_ = {{kFalseTerm, kTrueTerm}, {kTrueTerm, kFalseTerm}};
}

std::span<const Term> Terms::operands(Term term) const {
  return {operands_.data() + nodes_[term].first, nodes_[term].count};
}

Term Terms::add(Node node, const std::vector<Term>& operands) {
  std::size_t hash = static_cast<std::size_t>(node.kind) * 2 + (node.negated ? 1 : 0);
  hash = mixed(hash, node.proposition);
  for (const Term each : operands) hash = mixed(hash, each);
  const auto [begin, end] = index_.equal_range(hash);
  for (auto found = begin; found != end; ++found) {
    const Node& other = nodes_[found->second];
    if (other.kind == node.kind && other.negated == node.negated && other.proposition == node.proposition &&
        std::ranges::equal(this->operands(found->second), operands)) {
      return found->second;
    }
  }
  node.has_until = node.kind == TermKind::Until;
  node.has_release = node.kind == TermKind::Release;
  node.has_next = node.kind == TermKind::Next;
  for (const Term each : operands) {
    node.has_until |= nodes_[each].has_until;
    node.has_release |= nodes_[each].has_release;
    node.has_next |= nodes_[each].has_next;
  }
  node.first = static_cast<std::uint32_t>(operands_.size());
  node.count = static_cast<std::uint32_t>(operands.size());
  operands_.insert(operands_.end(), operands.begin(), operands.end());
  const Term term = static_cast<Term>(nodes_.size());
  nodes_.push_back(node);
  index_.emplace(hash, term);
  return term;
}

Term Terms::literal(std::uint32_t proposition, bool negated) {
  Node node;
  node.kind = TermKind::Literal;
  node.proposition = proposition;
  node.negated = negated;
  return add(node, {});
}

Term Terms::join(TermKind kind, std::vector<Term> operands, Term neutral, Term deciding) {
  std::ranges::sort(operands);
  operands.erase(std::unique(operands.begin(), operands.end()), operands.end());
  std::erase(operands, neutral);
  if (std::ranges::binary_search(operands, deciding)) return deciding;
  if (operands.empty()) return neutral;
  if (operands.size() == 1) return operands.front();
  Node node;
  node.kind = kind;
  return add(node, operands);
}

Term Terms::conjunction(std::vector<Term> operands) {
  return join(TermKind::And, std::move(operands), kTrueTerm, kFalseTerm);
}

Term Terms::disjunction(std::vector<Term> operands) {
  return join(TermKind::Or, std::move(operands), kFalseTerm, kTrueTerm);
}

Term Terms::next(Term operand) {
  if (operand <= kTrueTerm) return operand;
  Node node;
  node.kind = TermKind::Next;
  return add(node, {operand});
}

Term Terms::until(Term left, Term right) {
  if (right <= kTrueTerm || left == kFalseTerm || left == right) return right;
  if (left == kTrueTerm && kind(right) == TermKind::Until && operands(right)[0] == kTrueTerm) return right;
  Node node;
  node.kind = TermKind::Until;
  return add(node, {left, right});
}

Term Terms::release(Term left, Term right) {
  if (right <= kTrueTerm || left == kTrueTerm || left == right) return right;
  if (left == kFalseTerm && kind(right) == TermKind::Release && operands(right)[0] == kFalseTerm)
    return right;
  Node node;
  node.kind = TermKind::Release;
  return add(node, {left, right});
}

Term Terms::dual(Term term) {
  // Operands first, with a list of what is open in place of recursion: formulas may be deep.
  std::vector<Term> open = {term};
  while (!open.empty()) {
    const Term top = open.back();
    const std::size_t before = open.size();
    if (!duals_.contains(top)) {
      for (const Term each : operands(top))
        if (!duals_.contains(each)) open.push_back(each);
    }
    if (open.size() != before) continue;
    open.pop_back();
    if (duals_.contains(top)) continue;
    const Term negation = dual_of(top);
    duals_.emplace(top, negation);
    duals_.emplace(negation, top);
  }
  return duals_.at(term);
}

Term Terms::dual_of(Term term) {
  std::vector<Term> negations;
  for (const Term each : operands(term)) negations.push_back(duals_.at(each));
  switch (kind(term)) {
    case TermKind::Literal:
      return literal(proposition(term), !negated(term));
    case TermKind::And:
      return disjunction(std::move(negations));
    case TermKind::Or:
      return conjunction(std::move(negations));
    case TermKind::Next:
      return next(negations[0]);
    case TermKind::Until:
      return release(negations[0], negations[1]);
    case TermKind::Release:
      return until(negations[0], negations[1]);
    default:
      return term == kTrueTerm ? kFalseTerm : kTrueTerm;
  }
}

Class classify(const Terms& terms, Term term) {
  if (!terms.has_release(term)) return Class::CoSafe;
  if (!terms.has_until(term)) return Class::Safe;
  std::vector<Term> open = {term};
  std::vector<bool> seen(terms.size(), false);
  while (!open.empty()) {
    const Term top = open.back();
    open.pop_back();
    if (seen[top] || !terms.has_release(top) || !terms.has_until(top)) continue;
    seen[top] = true;
    if (terms.kind(top) != TermKind::And && terms.kind(top) != TermKind::Or) return Class::Neither;
    for (const Term each : terms.operands(top)) open.push_back(each);
  }
  return Class::Mix;
}

}  // namespace stepwright::ltl

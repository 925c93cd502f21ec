#include "supervisor/ltl/automaton/progression.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace stepwright::ltl {

namespace {

// What is remembered of single letters: beyond it, it is forgotten and found again.
constexpr std::size_t kMostSteps = 4'000'000;
constexpr std::size_t kMostChanges = 16'000'000;

// How many obligations within one are looked at for weaker ones: none that is missed makes a state wrong.
constexpr std::size_t kNearest = 64;

}  // namespace

Progression::Progression(Terms terms, Term formula, std::size_t propositions, std::size_t most_nodes)
    : terms_(std::move(terms)), propositions_(propositions), diagram_(most_nodes) {
  require(formula);
  start_ = shape_[formula];
}

// Only what is asked for: the terms of negations that nobody needs must not cost anything.
void Progression::require(Term wanted) {
  shape_.resize(terms_.size(), kUnknown);
  std::vector<Term> open = {wanted}, missing;
  while (!open.empty()) {
    const Term term = open.back();
    open.pop_back();
    if (shape_[term] != kUnknown) continue;
    shape_[term] = Diagram::kFalse;
    missing.push_back(term);
    for (const Term each : terms_.operands(term)) open.push_back(each);
  }
  std::ranges::sort(missing);  // operands first
  order(missing);
  weaker_.resize(terms_.size());
  for (const Term term : missing) {
    shape_[term] = shape_of(term);
    weaker_[term] = weaker_of(term);
  }
}

// `F b` is weaker than `F(a & F b)`.
std::vector<Term> Progression::weaker_of(Term term) const {
  std::vector<Term> found;
  const auto is_eventually = [&](Term each) {
    return terms_.kind(each) == TermKind::Until && terms_.operands(each)[0] == kTrueTerm;
  };
  if (!is_eventually(term) || terms_.kind(terms_.operands(term)[1]) != TermKind::And) return found;
  for (const Term each : terms_.operands(terms_.operands(term)[1]))
    if (is_eventually(each)) found.push_back(each);
  return found;
}

// An obligation becomes, with a letter, a function of itself and of obligations within it. So those that have
// one within them in common stand behind it, one next to the other: where `F b` comes to stand for many
// `F(a & F b)`, the diagram changes in one place only.
void Progression::order(const std::vector<Term>& required) {
  level_.resize(terms_.size(), Diagram::kNoLevel);
  std::unordered_map<Term, std::vector<Term>> around;
  for (const Term term : required)
    for (const Term each : terms_.operands(term)) around[each].push_back(term);
  std::unordered_set<Term> met;
  const auto place_from = [&](Term root) {
    std::vector<Term> open = {root};
    while (!open.empty()) {
      const Term term = open.back();
      open.pop_back();
      if (!met.insert(term).second) continue;
      const TermKind kind = terms_.kind(term);
      if (kind != TermKind::And && kind != TermKind::Or) {
        level_[term] = static_cast<std::uint32_t>(propositions_ + obligations_.size());
        obligations_.push_back(term);
      }
      if (kind == TermKind::Literal) continue;
      const std::vector<Term>& wider = around[term];
      open.insert(open.end(), wider.rbegin(), wider.rend());
    }
  };
  for (const Term term : required)
    if (term > kTrueTerm) place_from(term);
}

Diagram::Node Progression::joined(const std::vector<Diagram::Node>& parts, Term list) {
  const bool all = terms_.kind(list) == TermKind::And;
  std::vector<Diagram::Node> nodes;
  for (const Term each : terms_.operands(list)) nodes.push_back(parts[each]);
  // The lowest first: from there the diagram grows upwards.
  std::ranges::sort(nodes, std::greater<>(), [&](Diagram::Node each) { return diagram_.level(each); });
  Diagram::Node whole = all ? Diagram::kTrue : Diagram::kFalse;
  for (const Diagram::Node each : nodes)
    whole = all ? diagram_.both(each, whole) : diagram_.either(each, whole);
  return whole;
}

Diagram::Node Progression::shape_of(Term term) {
  switch (terms_.kind(term)) {
    case TermKind::True:
      return Diagram::kTrue;
    case TermKind::False:
      return Diagram::kFalse;
    case TermKind::And:
    case TermKind::Or:
      return joined(shape_, term);
    default:
      return diagram_.variable(level_[term]);
  }
}

Diagram::Node Progression::change_of(const std::vector<Diagram::Node>& changes, Term term,
                                     std::optional<Letter> letter) {
  const auto operands = terms_.operands(term);
  switch (terms_.kind(term)) {
    case TermKind::True:
      return Diagram::kTrue;
    case TermKind::False:
      return Diagram::kFalse;
    case TermKind::Literal: {
      const std::uint32_t asked = terms_.proposition(term);
      if (letter)
        return (*letter >> asked & 1) != (terms_.negated(term) ? 1 : 0) ? Diagram::kTrue : Diagram::kFalse;
      const Diagram::Node holds = diagram_.variable(asked);
      return terms_.negated(term) ? diagram_.negation(holds) : holds;
    }
    case TermKind::And:
    case TermKind::Or:
      return joined(changes, term);
    case TermKind::Next:
      return shape_[operands[0]];
    case TermKind::Until:  // b, or a now and the whole again
      return diagram_.either(changes[operands[1]], diagram_.both(changes[operands[0]], shape_[term]));
    case TermKind::Release:  // b, and a now or the whole again
      return diagram_.both(changes[operands[1]], diagram_.either(changes[operands[0]], shape_[term]));
  }
  return Diagram::kFalse;
}

// The change of a term and of what it is made of. Nothing else: a conjunction of many obligations, asked for
// all letters at once, would have to tell all combinations of their propositions from each other.
void Progression::fill(std::vector<Diagram::Node>& changes, Term wanted, std::optional<Letter> letter) {
  changes.resize(terms_.size(), kUnknown);
  std::vector<Term> open = {wanted}, missing;
  std::unordered_set<Term> met;
  while (!open.empty()) {
    const Term term = open.back();
    open.pop_back();
    if (changes[term] != kUnknown || !met.insert(term).second) continue;
    missing.push_back(term);
    if (terms_.kind(term) == TermKind::Next) continue;
    for (const Term each : terms_.operands(term)) open.push_back(each);
  }
  std::ranges::sort(missing);  // operands first
  for (const Term term : missing) changes[term] = change_of(changes, term, letter);
}

Diagram::Node Progression::change(Term obligation) {
  if (obligation >= change_.size() || change_[obligation] == kUnknown)
    fill(change_, obligation, std::nullopt);
  return change_[obligation];
}

Diagram::Node Progression::change(Term obligation, Letter letter) {
  if (changes_.size() * terms_.size() > kMostChanges) changes_.clear();
  std::vector<Diagram::Node>& changes = changes_[letter];
  if (obligation >= changes.size() || changes[obligation] == kUnknown) fill(changes, obligation, letter);
  return changes[obligation];
}

Verdict Progression::verdict(State state) {
  if (state == Diagram::kTrue) return Verdict::True;
  return state == Diagram::kFalse ? Verdict::False : Verdict::Undecided;
}

// Nodes of a state whose answer is not known yet, parts before the whole.
template <typename Known, typename Parts>
std::vector<Progression::State> Progression::unknown_below(State state, const Known& known,
                                                           const Parts& parts) const {
  std::vector<State> open = {state}, found;
  std::unordered_set<State> met;
  while (!open.empty()) {
    const State at = open.back();
    open.pop_back();
    if (at <= Diagram::kTrue || known(at) || !met.insert(at).second) continue;
    found.push_back(at);
    parts(at, open);
  }
  std::ranges::sort(found);
  return found;
}

// Most states are rows: v1 | v2 | ... | rest, or the same with &. What becomes of their members is laid
// together in one go, the lowest first: one by one would leave a row of nodes for each.
Progression::Row Progression::row_of(State state) const {
  Row row{diagram_.high(state) == Diagram::kTrue, {}, state};
  const State deciding = row.any ? Diagram::kTrue : Diagram::kFalse;
  const auto in_row = [&](State at) {
    return at > Diagram::kTrue && (row.any ? diagram_.high(at) : diagram_.low(at)) == deciding;
  };
  for (; in_row(row.rest); row.rest = row.any ? diagram_.low(row.rest) : diagram_.high(row.rest))
    row.members.push_back(row.rest);
  return row;
}

// Whether an obligation implies another one that is marked.
bool Progression::implies_marked(Term term, std::vector<Term>& marked) {
  marked.clear();
  std::vector<Term>& open = walk_;
  open.assign(1, term);
  for (std::size_t k = 0; k < open.size() && k < kNearest; ++k) {
    for (const Term each : weaker_[open[k]]) {
      if (mark_[each] == stamp_)
        marked.push_back(each);
      else
        open.push_back(each);
    }
  }
  return !marked.empty();
}

// Of two obligations of which one implies the other one is enough: the weaker one in a row of |, the stronger
// one in a row of &.
void Progression::drop_implied(std::vector<State>& pieces, bool any) {
  ++stamp_;
  mark_.resize(terms_.size(), 0);
  for (const State each : pieces)
    if (is_variable(each)) mark_[obligation(each)] = stamp_;
  std::vector<Term> marked;
  std::vector<State> dropped;
  for (const State each : pieces) {
    if (!is_variable(each) || !implies_marked(obligation(each), marked)) continue;
    if (any) dropped.push_back(each);
    for (const Term weaker : marked)
      if (!any) dropped.push_back(shape_[weaker]);
  }
  if (dropped.empty()) return;
  std::ranges::sort(dropped);
  std::erase_if(pieces, [&](State each) { return std::ranges::binary_search(dropped, each); });
}

Progression::State Progression::row_after(const Row& row, State rest, Letter letter) {
  const State neutral = row.any ? Diagram::kFalse : Diagram::kTrue, deciding = Diagram::kTrue - neutral;
  std::vector<State> parts = {rest}, pieces;
  for (const State each : row.members) parts.push_back(change(obligation(each), letter));
  for (const State part : parts) {
    if (part == deciding) return deciding;
    if (part == neutral) continue;
    const Row inner = row_of(part);
    if (inner.any == row.any) {
      for (const State each : inner.members) pieces.push_back(diagram_.variable(diagram_.level(each)));
      if (inner.rest != neutral) pieces.push_back(inner.rest);
    } else {
      pieces.push_back(part);
    }
  }
  std::ranges::sort(pieces, std::greater<>(),
                    [&](State each) { return std::pair(diagram_.level(each), each); });
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  drop_implied(pieces, row.any);
  State whole = neutral;
  for (const State each : pieces) {
    const std::uint32_t level = diagram_.level(each);
    if (is_variable(each) && level < diagram_.level(whole))
      whole = row.any ? diagram_.make(level, whole, deciding) : diagram_.make(level, deciding, whole);
    else
      whole = row.any ? diagram_.either(each, whole) : diagram_.both(each, whole);
  }
  return whole;
}

Progression::State Progression::next(State state, Letter letter) {
  if (next_.size() > kMostSteps) next_.clear();
  const auto known = [&](State at) { return next_.contains({at, letter}); };
  const auto after = [&](State at) { return at <= Diagram::kTrue ? at : next_.at({at, letter}); };
  const auto parts = [&](State at, std::vector<State>& open) {
    const Row row = row_of(at);
    if (!row.members.empty()) return open.push_back(row.rest);
    open.push_back(diagram_.low(at));
    open.push_back(diagram_.high(at));
  };
  for (const State at : unknown_below(state, known, parts)) {
    const Row row = row_of(at);
    const State whole = row.members.empty()
                            ? diagram_.choose(change(obligation(at), letter), after(diagram_.high(at)),
                                              after(diagram_.low(at)))
                            : row_after(row, after(row.rest), letter);
    if (exhausted()) return Diagram::kFalse;
    next_.emplace(Step{at, letter}, whole);
  }
  return after(state);
}

Diagram::Node Progression::successors(State state) {
  const auto after = [&](State at) { return at <= Diagram::kTrue ? at : successors_.at(at); };
  const auto known = [&](State at) { return successors_.contains(at); };
  const auto parts = [&](State at, std::vector<State>& open) {
    open.push_back(diagram_.low(at));
    open.push_back(diagram_.high(at));
  };
  for (const State at : unknown_below(state, known, parts)) {
    const Diagram::Node low = after(diagram_.low(at)), high = after(diagram_.high(at));
    const Diagram::Node whole = diagram_.choose(change(obligation(at)), high, low);
    if (exhausted()) return Diagram::kFalse;
    successors_.emplace(at, whole);
  }
  return after(state);
}

// States are monotone in their obligations: f = low | v & high. So !f is !low & (!v | !high).
Progression::State Progression::dual(State state) {
  const auto negation = [&](State at) { return at <= Diagram::kTrue ? Diagram::kTrue - at : duals_.at(at); };
  const auto known = [&](State at) { return duals_.contains(at); };
  const auto parts = [&](State at, std::vector<State>& open) {
    open.push_back(diagram_.low(at));
    open.push_back(diagram_.high(at));
  };
  for (const State at : unknown_below(state, known, parts)) {
    const Term contrary = terms_.dual(obligation(at));
    require(contrary);
    const State low = negation(diagram_.low(at)), high = negation(diagram_.high(at));
    const State whole = diagram_.both(low, diagram_.either(shape_[contrary], high));
    if (exhausted()) return Diagram::kFalse;
    duals_.emplace(at, whole);
  }
  return negation(state);
}

}  // namespace stepwright::ltl

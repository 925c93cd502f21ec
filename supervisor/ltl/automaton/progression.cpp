#include "supervisor/ltl/automaton/progression.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace stepwright::ltl {

Progression::Progression(Terms terms, Term formula, std::size_t propositions, std::size_t most_nodes)
    : _terms(std::move(terms)), _propositions(propositions), _diagram(most_nodes) {
  require(formula);
  _start = _shape[formula];
}

Diagram::Node Progression::variable(Term term) {
  return _diagram.variable(static_cast<std::uint32_t>(_propositions) + term);
}

// Only what is asked for: the terms of negations that nobody needs must not cost anything.
void Progression::require(Term wanted) {
  _shape.resize(_terms.size(), Diagram::kFalse);
  _change.resize(_terms.size(), Diagram::kFalse);
  _ready.resize(_terms.size(), false);
  std::vector<Term> open = {wanted}, missing;
  while (!open.empty()) {
    const Term term = open.back();
    open.pop_back();
    if (_ready[term]) continue;
    _ready[term] = true;
    missing.push_back(term);
    for (const Term each : _terms.operands(term)) open.push_back(each);
  }
  std::ranges::sort(missing);  // operands first
  for (const Term term : missing) {
    if (exhausted()) return;
    const TermKind kind = _terms.kind(term);
    if (kind == TermKind::And || kind == TermKind::Or) {
      // The last operand lies lowest: from there the diagram grows upwards.
      const bool all = kind == TermKind::And;
      Diagram::Node shape = all ? Diagram::kTrue : Diagram::kFalse;
      const auto operands = _terms.operands(term);
      for (std::size_t k = operands.size(); k-- > 0;)
        shape = all ? _diagram.both(_shape[operands[k]], shape) : _diagram.either(_shape[operands[k]], shape);
      _shape[term] = shape;
    } else {
      _shape[term] = term == kTrueTerm    ? Diagram::kTrue
                     : term == kFalseTerm ? Diagram::kFalse
                                          : variable(term);
    }
    _change[term] = change_of(term);
  }
}

Diagram::Node Progression::change_of(Term term) {
  const auto operands = _terms.operands(term);
  switch (_terms.kind(term)) {
    case TermKind::Literal: {
      const Diagram::Node holds = _diagram.variable(_terms.proposition(term));
      return _terms.negated(term) ? _diagram.negation(holds) : holds;
    }
    case TermKind::And:
    case TermKind::Or: {
      const bool all = _terms.kind(term) == TermKind::And;
      Diagram::Node change = all ? Diagram::kTrue : Diagram::kFalse;
      for (std::size_t k = operands.size(); k-- > 0;)
        change =
            all ? _diagram.both(_change[operands[k]], change) : _diagram.either(_change[operands[k]], change);
      return change;
    }
    case TermKind::Next:
      return _shape[operands[0]];
    case TermKind::Until:  // b, or a now and the whole again
      return _diagram.either(_change[operands[1]], _diagram.both(_change[operands[0]], variable(term)));
    case TermKind::Release:  // b, and a now or the whole again
      return _diagram.both(_change[operands[1]], _diagram.either(_change[operands[0]], variable(term)));
    default:
      return term == kTrueTerm ? Diagram::kTrue : Diagram::kFalse;
  }
}

Verdict Progression::verdict(State state) {
  if (state == Diagram::kTrue) return Verdict::True;
  return state == Diagram::kFalse ? Verdict::False : Verdict::Undecided;
}

Diagram::Node Progression::with(Diagram::Node node, Letter letter) const {
  while (!is_state(node))
    node = (letter >> _diagram.level(node) & 1) != 0 ? _diagram.high(node) : _diagram.low(node);
  return node;
}

Progression::State Progression::next(State state, Letter letter) {
  if (state <= Diagram::kTrue) return state;
  if (const auto known = _next.find({state, letter}); known != _next.end()) return known->second;
  std::unordered_map<State, State> done;
  const State after = next_of(state, letter, done);
  if (!exhausted()) _next.emplace(Step{state, letter}, after);
  return after;
}

Progression::State Progression::next_of(State state, Letter letter, std::unordered_map<State, State>& done) {
  if (state <= Diagram::kTrue || exhausted()) return state;
  if (const auto known = done.find(state); known != done.end()) return known->second;
  const bool any = _diagram.high(state) == Diagram::kTrue, all = _diagram.low(state) == Diagram::kFalse;
  State after = Diagram::kFalse;
  if (any || all) {
    after = row_after(state, letter, any, done);
  } else {
    const State low = next_of(_diagram.low(state), letter, done);
    const State high = next_of(_diagram.high(state), letter, done);
    after = _diagram.choose(with(_change[obligation(state)], letter), high, low);
  }
  done.emplace(state, after);
  return after;
}

// Most states are rows: v1 | v2 | ... | rest, or the same with &. What becomes of their members are mostly
// rows again, which are laid together by their levels in one go: one by one would leave a row of nodes for
// each.
Progression::State Progression::row_after(State state, Letter letter, bool any,
                                          std::unordered_map<State, State>& done) {
  const State neutral = any ? Diagram::kFalse : Diagram::kTrue,
              deciding = any ? Diagram::kTrue : Diagram::kFalse;
  const auto in_row = [&](State at) {
    return at > Diagram::kTrue && (any ? _diagram.high(at) : _diagram.low(at)) == deciding;
  };
  const auto rest = [&](State at) { return any ? _diagram.low(at) : _diagram.high(at); };
  std::vector<State> parts;
  State at = state;
  for (; in_row(at); at = rest(at)) parts.push_back(with(_change[obligation(at)], letter));
  parts.push_back(next_of(at, letter, done));
  std::vector<std::uint32_t> levels;
  std::vector<State> others;
  for (State part : parts) {
    for (; in_row(part); part = rest(part)) levels.push_back(_diagram.level(part));
    if (part == deciding) return deciding;
    if (part != neutral) others.push_back(part);
  }
  std::ranges::sort(levels, std::greater<>());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  State row = neutral;
  for (const std::uint32_t level : levels)
    row = any ? _diagram.make(level, row, Diagram::kTrue) : _diagram.make(level, Diagram::kFalse, row);
  for (const State other : others) row = any ? _diagram.either(row, other) : _diagram.both(row, other);
  return row;
}

Diagram::Node Progression::successors(State state) {
  if (state <= Diagram::kTrue || exhausted()) return state;
  if (const auto known = _successors.find(state); known != _successors.end()) return known->second;
  const Diagram::Node low = successors(_diagram.low(state)), high = successors(_diagram.high(state));
  const Diagram::Node after = _diagram.choose(_change[obligation(state)], high, low);
  if (!exhausted()) _successors.emplace(state, after);
  return after;
}

// States are monotone in their obligations: f = low | v & high. So !f is !low & (!v | !high).
Progression::State Progression::dual(State state) {
  if (state <= Diagram::kTrue) return state == Diagram::kTrue ? Diagram::kFalse : Diagram::kTrue;
  if (const auto known = _duals.find(state); known != _duals.end()) return known->second;
  const State low = dual(_diagram.low(state)), high = dual(_diagram.high(state));
  const Term negation = _terms.dual(obligation(state));
  require(negation);
  const State answer = _diagram.both(low, _diagram.either(_shape[negation], high));
  if (!exhausted()) _duals.emplace(state, answer);
  return answer;
}

}  // namespace stepwright::ltl

#include "supervisor/ltl/trace/judge.h"

#include "supervisor/ltl/automaton/progression.h"

namespace stepwright::ltl {

namespace {

constexpr std::size_t kMostParts = 200, kTextWidth = 200;

// Of a conjunction; a formula that is none, or has too many, has no parts.
std::vector<SyntaxId> parts_of(const SyntaxTree& tree) {
  std::vector<SyntaxId> parts = conjuncts(tree);
  if (parts.size() < 2 || parts.size() > kMostParts) parts.clear();
  return parts;
}

result::Result<Judged> judge_one(const Formula& formula, const Trace& trace, const BuildOptions& options,
                                 const std::string& file) {
  auto monitor = monitor_automaton(formula, options, file);
  if (monitor) return judge(monitor->automaton, trace);
  if (monitor.error().front().code == kNotMonitorable) return result::forward(monitor);
  Progression progression(formula.terms, formula.root, formula.proposition_count(), options.most_nodes);
  Progression::State state = progression.start();
  Judged judged{Progression::verdict(state), std::nullopt, 0, true};
  for (std::size_t k = 0; k < trace.changes.size() && judged.verdict == Verdict::Undecided; ++k) {
    state = progression.next(state, trace.changes[k].letter);
    if (progression.exhausted()) break;
    judged.verdict = Progression::verdict(state);
    if (judged.verdict != Verdict::Undecided) judged.decided_at = k;
  }
  if (progression.exhausted()) return result::forward(monitor);
  return judged;
}

JudgedPart judge_part(const Formula& formula, SyntaxId id, const Trace& trace, const BuildOptions& options) {
  Formula part = formula;
  part.tree.root = id;
  part.root = formula.positive[id];
  JudgedPart judged{to_text(formula.tree, id, kTextWidth),
                    formula.tree.nodes[id].at,
                    classify(part.terms, part.root),
                    {},
                    true};
  const auto found = judge_one(part, trace, options, {});
  judged.told = found.has_value();
  if (found) judged.judged = *found;
  return judged;
}

}  // namespace

Judged judge(const Automaton& automaton, const Trace& trace) {
  Judged judged{automaton.verdicts[automaton.initial], std::nullopt, automaton.initial, false};
  for (std::size_t k = 0; k < trace.changes.size() && judged.verdict == Verdict::Undecided; ++k) {
    judged.state = automaton.next(judged.state, trace.changes[k].letter);
    judged.verdict = automaton.verdicts[judged.state];
    if (judged.verdict != Verdict::Undecided) judged.decided_at = k;
  }
  return judged;
}

result::Result<Judgement> judge(const Formula& formula, const Trace& trace, const BuildOptions& options,
                                const std::string& file) {
  auto whole = judge_one(formula, trace, options, file);
  if (!whole) return result::forward(whole);
  Judgement judgement{*whole, {}, stutter_report(formula, options)};
  for (const SyntaxId id : parts_of(formula.tree))
    judgement.parts.push_back(judge_part(formula, id, trace, options));
  return judgement;
}

}  // namespace stepwright::ltl

#include "supervisor/ltl/trace/judge.h"

namespace stepwright::ltl {

namespace {

constexpr std::size_t kMostParts = 200, kTextWidth = 200;

// Of a conjunction; a formula that is none, or has too many, has no parts.
std::vector<SyntaxId> parts_of(const SyntaxTree& tree) {
  std::vector<SyntaxId> parts = conjuncts(tree);
  if (parts.size() < 2 || parts.size() > kMostParts) parts.clear();
  return parts;
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
  const auto monitor = monitor_automaton(part, options);
  if (monitor)
    judged.judged = judge(monitor->automaton, trace);
  else
    judged.told = false;
  return judged;
}

}  // namespace

Judged judge(const Automaton& automaton, const Trace& trace) {
  Judged judged{automaton.verdicts[automaton.initial], std::nullopt, automaton.initial};
  for (std::size_t k = 0; k < trace.changes.size() && judged.verdict == Verdict::Undecided; ++k) {
    judged.state = automaton.next(judged.state, trace.changes[k].letter);
    judged.verdict = automaton.verdicts[judged.state];
    if (judged.verdict != Verdict::Undecided) judged.decided_at = k;
  }
  return judged;
}

result::Result<Judgement> judge(const Formula& formula, const Trace& trace, const BuildOptions& options,
                                const std::string& file) {
  const auto monitor = monitor_automaton(formula, options, file);
  if (!monitor) return tl::unexpected<result::Diagnostics>(monitor.error());
  Judgement judgement{judge(monitor->automaton, trace), {}, stutter_report(formula, options)};
  for (const SyntaxId id : parts_of(formula.tree))
    judgement.parts.push_back(judge_part(formula, id, trace, options));
  return judgement;
}

}  // namespace stepwright::ltl

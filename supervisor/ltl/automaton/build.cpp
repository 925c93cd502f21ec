#include "supervisor/ltl/automaton/build.h"

#include <algorithm>
#include <utility>

#include "supervisor/ltl/automaton/emptiness.h"
#include "supervisor/ltl/automaton/exploration.h"

namespace stepwright::ltl {

namespace {

constexpr const char* kSymbolicHint =
    "raise the bound, or step through the formula without a table (Progression)";

result::Location place(const Formula& formula, const std::string& file, SyntaxId at) {
  return {file, formula.tree.nodes[at].at.line, formula.tree.nodes[at].at.column};
}

tl::unexpected<result::Diagnostics> beyond(const Exploration& explored, const Formula& formula,
                                           const std::string& file, const BuildOptions& options) {
  const auto where = place(formula, file, formula.tree.root);
  if (explored.too_many_states()) {
    return result::fail("L0012", where,
                        "the automaton has more than " + std::to_string(options.most_states) + " states",
                        kSymbolicHint);
  }
  return result::fail("L0013", where,
                      "the decision diagrams have more than " + std::to_string(options.most_nodes) + " nodes",
                      kSymbolicHint);
}

Automaton assembled(Exploration& explored, const Formula& formula, std::vector<Verdict> verdicts) {
  Automaton automaton;
  automaton.propositions = formula.tree.propositions;
  automaton.guards = std::move(explored.guards());
  automaton.edges = explored.edges();
  automaton.verdicts = std::move(verdicts);
  return minimised(automaton);
}

std::vector<Verdict> verdicts_of(const std::vector<bool>& is_true, const std::vector<bool>& is_false) {
  std::vector<Verdict> verdicts(is_true.size(), Verdict::Undecided);
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    if (is_true[k]) verdicts[k] = Verdict::True;
    if (is_false[k]) verdicts[k] = Verdict::False;
  }
  return verdicts;
}

std::vector<bool> equal_to(const Exploration& explored, Progression::State wanted) {
  std::vector<bool> found;
  for (const Progression::State each : explored.states()) found.push_back(each == wanted);
  return found;
}

// Every infinite word decides a co-safe formula by reaching True, or never does: what cannot reach it is
// False. For safe formulas the same with False.
std::vector<Verdict> decided_by_reach(const Exploration& explored, Progression::State sure, bool early) {
  const std::vector<bool> seeds = equal_to(explored, sure);
  const Reach reach = explored.reach();
  const std::vector<bool> reached = early ? reach.every(seeds) : seeds;
  std::vector<bool> never = reach.some(seeds);
  never.flip();
  return sure == Diagram::kTrue ? verdicts_of(reached, never) : verdicts_of(never, reached);
}

bool never_told(const Automaton& automaton) {
  Reach reach(automaton.size());
  std::vector<bool> decided;
  for (std::uint32_t state = 0; state < automaton.size(); ++state) {
    decided.push_back(automaton.verdicts[state] != Verdict::Undecided);
    std::vector<std::uint32_t> after;
    automaton.guards.collect(automaton.edges[state], after);
    for (const std::uint32_t each : after) reach.add(state, each);
  }
  const std::vector<bool> tells = reach.some(decided);
  return std::find(tells.begin(), tells.end(), false) != tells.end();
}

}  // namespace

result::Result<Automaton> task_automaton(const Formula& formula, const BuildOptions& options,
                                         const std::string& file) {
  if (formula.terms.has_release(formula.root)) {
    const SyntaxId part = not_cosafe_part(formula);
    return result::fail(
        "L0011", place(formula, file, part),
        "'" + to_text(formula.tree, part, 60) +
            "' is not co-safe here: no finite run is enough to satisfy it",
        "a plan ends: say until when it is asked for ('a U b', 'a before b'), or watch it with a monitor");
  }
  Progression progression(formula.terms, formula.root, formula.proposition_count(), options.most_nodes);
  Exploration explored(progression, options);
  if (!explored.run()) return beyond(explored, formula, file, options);
  return assembled(explored, formula,
                   decided_by_reach(explored, Diagram::kTrue, options.acceptance == Acceptance::Early));
}

result::Result<Monitor> monitor_automaton(const Formula& formula, const BuildOptions& options,
                                          const std::string& file) {
  Progression progression(formula.terms, formula.root, formula.proposition_count(), options.most_nodes);
  Exploration explored(progression, options);
  if (!explored.run()) return beyond(explored, formula, file, options);
  Monitor monitor;
  monitor.kind = classify(formula.terms, formula.root);
  std::vector<Verdict> verdicts;
  if (monitor.kind == Class::CoSafe || monitor.kind == Class::Safe) {
    verdicts =
        decided_by_reach(explored, monitor.kind == Class::CoSafe ? Diagram::kTrue : Diagram::kFalse, true);
  } else {
    std::vector<Progression::State> states = explored.states();
    for (std::size_t k = 0, count = states.size(); k < count; ++k)
      states.push_back(progression.dual(states[k]));
    const auto answers = satisfiable(progression, states, options.most_nodes);
    if (!answers) {
      return result::fail("L0015", place(formula, file, formula.tree.root),
                          "whether the rest can still be satisfied takes more than " +
                              std::to_string(options.most_nodes) +
                              " steps, more than 64 'until' or more than 2000 obligations",
                          "raise the bound, or watch the parts of the formula one by one");
    }
    const auto middle = answers->begin() + static_cast<std::ptrdiff_t>(answers->size() / 2);
    std::vector<bool> is_false(answers->begin(), middle), is_true(middle, answers->end());
    is_false.flip();
    is_true.flip();
    verdicts = verdicts_of(is_true, is_false);
  }
  monitor.automaton = assembled(explored, formula, std::move(verdicts));
  const std::vector<Verdict>& told = monitor.automaton.verdicts;
  if (std::ranges::all_of(told, [](Verdict each) { return each == Verdict::Undecided; })) {
    return result::fail(
        kNotMonitorable, place(formula, file, formula.tree.root),
        "'" + to_text(formula.tree, formula.tree.root, 60) +
            "' cannot be monitored: whatever was read, it may still come true and may still fail",
        "give what shall happen a last moment, such as 'a U b' in place of 'F b' within G");
  }
  monitor.may_never_tell = never_told(monitor.automaton);
  return monitor;
}

StutterReport stutter_report(const Formula& formula, const BuildOptions& options) {
  if (!formula.terms.has_next(formula.root)) return {};
  const Class kind = classify(formula.terms, formula.root);
  if (kind != Class::CoSafe && kind != Class::Safe)
    return {StutterKind::Unknown, "X together with formulas that no finite word decides"};
  BuildOptions exact = options;
  exact.acceptance = Acceptance::Early;
  const auto monitor = monitor_automaton(formula, exact);
  if (!monitor) return {StutterKind::Unknown, monitor.error().front().message};
  const StutterAnswer answer = stutter(monitor->automaton);
  if (answer.invariant) return {};
  std::string letter;
  for (std::size_t k = 0; k < formula.proposition_count(); ++k)
    if ((answer.example >> k & 1) != 0) letter += (letter.empty() ? "" : ", ") + formula.tree.propositions[k];
  return {StutterKind::Sensitive, "it tells {" + letter +
                                      "} from the same letter twice: X counts letters, and a word of "
                                      "label changes never has one letter twice in a row"};
}

}  // namespace stepwright::ltl

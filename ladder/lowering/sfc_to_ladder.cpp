#include "ladder/lowering/sfc_to_ladder.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <set>
#include <utility>

#include "ladder/lowering/condition_guard.h"
#include "ladder/lowering/sfc_actions.h"
#include "ladder/lowering/sfc_lowering_context.h"
#include "ladder/lowering/sfc_name_check.h"

namespace stepwright::lowering {
namespace {

using graphic::CoilKind;
using graphic::Condition;
using graphic::Pou;
using graphic::Rung;
using graphic::SfcChart;
using graphic::StepId;
using graphic::Transition;
using result::Diagnostics;

std::string names_of(const SfcChart& chart, const std::vector<StepId>& ids) {
  std::string text;
  for (const StepId id : ids) text += (text.empty() ? "" : " + ") + chart.steps[id.value].name;
  return text;
}

// The elapsed times, before the transitions read them.
void lower_clock(SfcLoweringContext& context) {
  if (context.now().empty()) return;
  Rung clock;
  clock.comment = "Clock of the step times";
  graphic::Block timer;
  timer.type = "TON";
  timer.instance = context.clock_timer();
  timer.power_input = "IN";
  timer.inputs.emplace_back("PT", "T#36500d");  // a hundred years: it never stands still
  timer.outputs.emplace_back("ET", context.now());
  clock.blocks.push_back(std::move(timer));
  context.add(std::move(clock));
  for (const StepVariables& step : context.steps()) {
    if (step.elapsed.empty()) continue;
    context.add(statements("Elapsed time " + step.elapsed, graphic::contact(step.active),
                           step.elapsed + " := " + context.now() + " - " + step.entered_at + ";"));
  }
}

// A transition names those that go before it, up to this many of a step. Where a step has more, a bit of the
// step says that one of them fires: the rungs of n transitions would hold n * n / 2 contacts otherwise.
constexpr std::size_t kMostNamedRivals = 8;

// What shuts out a transition: those with a common source that go before it.
class Rivals {
 public:
  explicit Rivals(SfcLoweringContext& context)
      : context_(context), before_(context.chart().steps.size()), leaves_(before_.size()) {
    std::vector<std::size_t> leaving(before_.size(), 0);
    for (const Transition& each : context.chart().transitions)
      for (const StepId source : each.sources) ++leaving[source.value];
    for (std::size_t i = 0; i < leaving.size(); ++i) {
      const std::string& step = context.chart().steps[i].name;
      if (leaving[i] > kMostNamedRivals + 1)
        leaves_[i] = context.declare(step + "_LEAVES", "BOOL", "a transition out of step " + step + " fires");
    }
  }

  // To be asked for the transitions in the order of their priority. Adds to the rung what shuts the
  // transition out, and the coils that tell those behind it.
  void add(std::size_t transition, std::vector<Condition>& series, Rung& rung) {
    std::set<std::size_t> named;
    for (const StepId source : context_.chart().transitions[transition].sources) {
      std::vector<std::size_t>& before = before_[source.value];
      const std::string& leaves = leaves_[source.value];
      if (leaves.empty()) {
        named.insert(before.begin(), before.end());
      } else {
        const bool first = before.empty();
        if (!first) series.push_back(graphic::contact(leaves, true));
        rung.coils.push_back({first ? CoilKind::Normal : CoilKind::Set, leaves});
      }
      if (leaves.empty() || before.empty()) before.push_back(next_);
    }
    order_.push_back(transition);
    ++next_;
    for (const std::size_t each : named) series.push_back(context_.fires(order_[each], true));
  }

 private:
  SfcLoweringContext& context_;
  std::vector<std::vector<std::size_t>> before_;  // by step: places in `order_`
  std::vector<std::string> leaves_;               // by step: its bit; empty: its transitions name each other
  std::vector<std::size_t> order_;
  std::size_t next_ = 0;
};

// In the order of their priority, so that a transition can look at the bits of those that go before it.
void lower_transition_bits(SfcLoweringContext& context) {
  const SfcChart& chart = context.chart();
  std::vector<std::size_t> order(chart.transitions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return chart.transitions[a].priority < chart.transitions[b].priority;
  });
  Rivals rivals(context);
  ConditionGuard guard(context);
  for (const std::size_t i : order) {
    const Transition& transition = chart.transitions[i];
    const std::string way =
        names_of(chart, transition.sources) + " -> " + names_of(chart, transition.targets);
    std::vector<Condition> series;
    for (const StepId source : transition.sources) series.push_back(context.active(source));
    const bool guarded = guard.guards(i);
    if (!guarded) series.push_back(context.rewrite(transition.condition));
    Rung rung;
    rung.comment = "Transition " + way;
    if (!guarded) rung.coils.push_back({CoilKind::Normal, context.fires(i).name});
    rivals.add(i, series, rung);
    guard.run_shared_network(i);
    if (guarded) {
      guard.evaluate(i, graphic::all(std::move(series)), way);
      if (rung.coils.empty()) continue;
      rung.comment += " goes before others";
      series = {context.fires(i)};
    }
    rung.condition = graphic::all(std::move(series));
    context.add(std::move(rung));
  }
}

void lower_evolution(SfcLoweringContext& context, CoilKind kind) {
  const SfcChart& chart = context.chart();
  for (std::size_t i = 0; i < chart.transitions.size(); ++i) {
    const Transition& transition = chart.transitions[i];
    const bool leave = kind == CoilKind::Reset;
    const std::vector<StepId>& steps = leave ? transition.sources : transition.targets;
    Rung rung;
    rung.comment = (leave ? "Leave " : "Enter ") + names_of(chart, steps);
    rung.condition = context.fires(i);
    for (const StepId step : steps) rung.coils.push_back({kind, context.steps()[step.value].active});
    context.add(std::move(rung));
  }
}

// The step bits are FALSE before the first scan, so no transition fires in it and the actions of the initial
// steps run before any transition is tested.
void lower_initial_situation(SfcLoweringContext& context) {
  Rung rung;
  rung.comment = "Initial situation";
  rung.condition = graphic::contact(context.first_scan());
  for (std::size_t i = 0; i < context.steps().size(); ++i) {
    if (context.chart().steps[i].initial) rung.coils.push_back({CoilKind::Set, context.steps()[i].active});
  }
  context.add(std::move(rung));
}

void lower_entry_times(SfcLoweringContext& context) {
  const SfcChart& chart = context.chart();
  std::vector<std::vector<std::size_t>> entering(chart.steps.size());  // transitions, by target
  for (std::size_t t = 0; t < chart.transitions.size(); ++t)
    for (const StepId target : chart.transitions[t].targets) entering[target.value].push_back(t);
  for (std::size_t i = 0; i < context.steps().size(); ++i) {
    const StepVariables& step = context.steps()[i];
    if (step.elapsed.empty()) continue;
    std::vector<Condition> entries;
    for (const std::size_t t : entering[i]) entries.push_back(context.fires(t));
    if (chart.steps[i].initial) entries.push_back(graphic::contact(context.first_scan()));
    if (entries.empty()) continue;  // a step that nothing enters
    context.add(statements("Time of step " + chart.steps[i].name + " starts",
                           graphic::any(std::move(entries)),
                           step.entered_at + " := " + context.now() + "; " + step.elapsed + " := T#0s;"));
  }
}

void lower_end_of_scan(SfcLoweringContext& context) {
  for (const StepVariables& step : context.steps()) {
    if (step.was_active.empty()) continue;
    Rung rung;
    rung.comment = "Remember " + step.active;
    rung.condition = graphic::contact(step.active);
    rung.coils.push_back({CoilKind::Normal, step.was_active});
    context.add(std::move(rung));
  }
  Rung rung;
  rung.comment = "End of the first scan";
  rung.coils.push_back({CoilKind::Reset, context.first_scan()});
  context.add(std::move(rung));
}

result::Result<Pou> lower(const Pou& pou, const std::vector<graphic::Variable>* globals,
                          ChartNetworks networks = {}) {
  assert(std::holds_alternative<SfcChart>(pou.body));
  Diagnostics diagnostics = graphic::check(std::get<SfcChart>(pou.body));
  if (!result::has_errors(diagnostics)) diagnostics = check_names(pou, globals);
  if (result::has_errors(diagnostics)) return tl::unexpected<Diagnostics>(std::move(diagnostics));

  SfcLoweringContext context(pou, std::move(networks));
  lower_clock(context);
  context.add_networks();
  lower_transition_bits(context);
  lower_evolution(context, CoilKind::Reset);
  lower_evolution(context, CoilKind::Set);
  lower_initial_situation(context);
  lower_entry_times(context);
  lower_actions(context);
  lower_end_of_scan(context);
  return context.finish();
}

}  // namespace

result::Result<Pou> lower_sfc(const Pou& pou) {
  return lower(pou, nullptr);
}

result::Result<Pou> lower_sfc(const Pou& pou, const std::vector<graphic::Variable>& globals) {
  return lower(pou, &globals);
}

result::Result<Pou> lower_sfc_beside(const Pou& pou, ChartNetworks networks) {
  return lower(pou, nullptr, std::move(networks));
}

result::Result<graphic::Project> lower_sfc(const graphic::Project& project) {
  graphic::Project lowered = project;
  for (Pou& pou : lowered.pous) {
    if (!std::holds_alternative<SfcChart>(pou.body)) continue;
    result::Result<Pou> ladder = lower(pou, &project.globals);
    if (!ladder) {
      for (result::Diagnostic& diagnostic : ladder.error()) {
        diagnostic.message = "POU '" + pou.name + "': " + diagnostic.message;
      }
      return result::forward(ladder);
    }
    pou = std::move(*ladder);
  }
  return lowered;
}

}  // namespace stepwright::lowering

#include <algorithm>
#include <cstdio>
#include <utility>

#include "supervisor/translate/action_conditions.h"
#include "supervisor/translate/chart_writer.h"
#include "supervisor/translate/monitors.h"
#include "supervisor/translate/plan_graph.h"
#include "supervisor/translate/sensor_program.h"
#include "supervisor/translate/translation.h"

namespace stepwright::translate {

namespace {

using graphic::Condition;
using graphic::StepId;

std::string two_digits(std::size_t number) {
  char text[24];
  std::snprintf(text, sizeof text, "%02zu", number);
  return text;
}

// The chart of one plan. Nodes are START (0), action i (i + 1) and SETTLE (last).
class PlanChart {
 public:
  PlanChart(const model::PlannedRun& run, const Binding& binding, const PlanGraph& graph,
            const std::vector<ActionConditions>& conditions, const Condition& snapshot, bool watch_effects)
      : run_(run),
        binding_(binding),
        conditions_(conditions),
        snapshot_(snapshot),
        watch_effects_(watch_effects),
        writer_(binding),
        settle_(run.actions.size() + 1),
        nodes_(run.actions.size() + 2) {
    link(graph);
  }

  void build() {
    add_steps();
    for (std::size_t node = 0; node < settle_; ++node) add_way_out(node);
    for (std::size_t node = 1; node <= settle_; ++node) add_joined_start(node);
    writer_.transition({nodes_[settle_].step}, {done_}, writer_.after(nodes_[settle_].step, binding_.settle),
                       "levels are at rest");
    for (std::size_t node = 0; node < settle_; ++node) add_failures(node);
  }

  ChartWriter& writer() { return writer_; }

 private:
  struct Node {
    StepId step;    // the action itself, START or SETTLE
    StepId exit;    // its rest step if it has one
    StepId failed;  // START and actions
    std::vector<std::size_t> before;
    std::vector<std::size_t> after;
    std::vector<StepId> waiting;  // wait steps in front, one for each node of `before`
  };

  const ActionConditions& of(std::size_t node) const { return conditions_[node - 1]; }
  bool is_action(std::size_t node) const { return node != 0 && node != settle_; }
  bool is_direct(std::size_t from, std::size_t to) const {
    return nodes_[from].after.size() == 1 && nodes_[to].before.size() == 1;
  }

  void connect(std::size_t from, std::size_t to) {
    nodes_[from].after.push_back(to);
    nodes_[to].before.push_back(from);
  }

  void link(const PlanGraph& graph) {
    for (std::size_t i = 0; i < graph.size(); ++i) {
      if (graph.predecessors[i].empty()) connect(0, i + 1);
    }
    for (const model::Ordering& edge : graph.orderings()) connect(edge.before + 1, edge.after + 1);
    for (std::size_t i = 0; i < graph.size(); ++i) {
      if (graph.successors[i].empty()) connect(i + 1, settle_);
    }
    if (graph.size() == 0) connect(0, settle_);
  }

  std::string action_name(std::size_t node) const {
    const std::string& name = run_.actions[node - 1].action.name;
    return two_digits(node) + "_" + graphic::upper(graphic::make_identifier(name));
  }

  StepId add(std::string name, StepKind kind, std::size_t node, std::string comment,
             const std::vector<std::string>& outputs = {}) {
    StepInfo info;
    info.name = std::move(name);
    info.kind = kind;
    if (is_action(node) && kind != StepKind::Wait) info.action = node - 1;
    // A token that waits behind an action proves it done; one in an action only what comes before.
    const std::vector<std::size_t> proof =
        kind == StepKind::Wait ? std::vector<std::size_t>{node} : nodes_[node].before;
    for (const std::size_t done : proof) {
      if (is_action(done)) info.after.push_back(done - 1);
    }
    if (kind == StepKind::Action) {
      info.timeout = of(node).entry->timeout;
      if (watch_effects_ && of(node).idle) info.idle = of(node).idle->after;
      info.assumed = of(node).guard.assumed;
    }
    return writer_.step(std::move(info), std::move(comment), outputs);
  }

  // Actions come right after START, so that step n of the controller is action n (the paper's Table 5).
  void add_steps() {
    nodes_[0].step = nodes_[0].exit = add("START", StepKind::Start, 0, "initial snapshot");
    for (std::size_t node = 1; node < settle_; ++node) {
      nodes_[node].step = nodes_[node].exit =
          add("S" + action_name(node), StepKind::Action, node, to_string(run_.actions[node - 1].action),
              of(node).entry->outputs);
    }
    nodes_[settle_].step = add("SETTLE", StepKind::Settle, settle_, "levels come to rest");
    done_ = add("DONE", StepKind::Done, settle_, "goal snapshot");
    for (std::size_t node = 1; node < settle_; ++node) {
      if (of(node).entry->rest.count() == 0) continue;
      nodes_[node].exit = add("R" + action_name(node), StepKind::Rest, node, "what runs out arrives");
    }
    for (std::size_t node = 1; node <= settle_; ++node) add_wait_steps(node);
    nodes_[0].failed = add("FAILED_START", StepKind::Failed, 0, "the initial snapshot is not as planned");
    for (std::size_t node = 1; node < settle_; ++node) {
      nodes_[node].failed = add("FAILED_S" + action_name(node), StepKind::Failed, node,
                                "not possible: " + to_string(run_.actions[node - 1].action));
    }
  }

  void add_wait_steps(std::size_t node) {
    for (const std::size_t from : nodes_[node].before) {
      if (is_direct(from, node)) continue;
      const std::string target = node == settle_ ? "SETTLE" : two_digits(node);
      nodes_[node].waiting.push_back(add("W" + two_digits(from) + "_" + target, StepKind::Wait, from, ""));
    }
  }

  // What must be true to leave a node: the snapshot after START, else the completion (after its rest).
  Condition exit_condition(std::size_t node) const {
    if (node == 0) return graphic::all({writer_.after(nodes_[0].step, binding_.start), snapshot_});
    if (nodes_[node].exit == nodes_[node].step) return of(node).complete;
    return writer_.after(nodes_[node].exit, of(node).entry->rest);
  }

  std::string exit_text(std::size_t node) const {
    return node == 0 ? "initial snapshot observed" : of(node).complete_text;
  }

  void add_way_out(std::size_t node) {
    const Node& here = nodes_[node];
    if (node != 0 && here.exit != here.step) {
      writer_.transition({here.step}, {here.exit}, of(node).complete, of(node).complete_text);
    }
    const std::string text = here.exit == here.step ? exit_text(node) : "rested";
    if (here.after.size() == 1 && is_direct(node, here.after.front())) {
      add_start({here.exit}, here.after.front(), exit_condition(node), text);
      return;
    }
    std::vector<StepId> targets;
    for (const std::size_t next : here.after) {
      const auto& before = nodes_[next].before;
      const auto place = std::find(before.begin(), before.end(), node) - before.begin();
      targets.push_back(nodes_[next].waiting[static_cast<std::size_t>(place)]);
    }
    writer_.transition({here.exit}, std::move(targets), exit_condition(node), text);
  }

  void add_joined_start(std::size_t node) {
    if (!nodes_[node].waiting.empty()) add_start(nodes_[node].waiting, node, graphic::always(), "");
  }

  // `condition` and the guard of `node` start it; `condition` without the guard is a failure of it.
  void add_start(const std::vector<StepId>& sources, std::size_t node, const Condition& condition,
                 std::string text) {
    if (node == settle_) {
      writer_.transition(sources, {nodes_[node].step}, condition, std::move(text));
      return;
    }
    const Condition guard = without(of(node).guard.condition, condition);
    writer_.transition(sources, {nodes_[node].step}, graphic::all({condition, guard}), std::move(text));
    if (const auto refused = inverse(guard)) {
      writer_.transition(sources, {nodes_[node].failed}, graphic::all({condition, *refused}),
                         "precondition not observed: " + to_string(run_.actions[node - 1].action));
    }
  }

  void add_failures(std::size_t node) {
    const Node& here = nodes_[node];
    if (node == 0) {
      if (const auto wrong = inverse(snapshot_)) {
        writer_.transition({here.step}, {here.failed},
                           graphic::all({writer_.after(here.step, binding_.start), *wrong}),
                           "initial snapshot not observed");
      }
      return;
    }
    std::vector<Condition> reasons;
    std::string text;
    for (const Condition& hold : of(node).hold) {
      reasons.push_back(*inverse(hold));
      text += "lost " + graphic::to_st(hold) + " or ";
    }
    if (watch_effects_ && of(node).idle) {
      const Idle& idle = *of(node).idle;
      reasons.push_back(graphic::all({writer_.after(here.step, idle.after), idle.condition}));
      text += "no effect or ";
    }
    reasons.push_back(writer_.after(here.step, of(node).entry->timeout));
    writer_.transition({here.step}, {here.failed}, graphic::any(std::move(reasons)), text + "timeout");
  }

  const model::PlannedRun& run_;
  const Binding& binding_;
  const std::vector<ActionConditions>& conditions_;
  const Condition& snapshot_;
  bool watch_effects_;
  ChartWriter writer_;
  std::size_t settle_;
  std::vector<Node> nodes_;
  StepId done_;
};

// The run's initial state with what was measured in place of what was planned for.
model::NamedState measured_start(const model::PlannedRun& run, const TranslateOptions& options) {
  model::NamedState state = run.initial;
  for (const auto& [fluent, value] : options.measured) state.fluents[fluent] = value;
  return state;
}

Offsets start_offsets(const model::PlannedRun& run, const TranslateOptions& options) {
  Offsets offsets;
  for (const auto& [fluent, value] : options.measured) {
    const auto planned = run.initial.fluents.find(fluent);
    if (planned != run.initial.fluents.end()) offsets[fluent] = value - planned->second;
  }
  return offsets;
}

}  // namespace

const graphic::SfcChart& Translation::chart() const {
  const auto found = std::find_if(project.pous.begin(), project.pous.end(),
                                  [this](const graphic::Pou& pou) { return pou.name == program; });
  return std::get<graphic::SfcChart>(found->body);
}

std::optional<std::size_t> Translation::step(std::string_view name) const {
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].name == name) return i;
  }
  return std::nullopt;
}

result::Result<Translation> translate(const model::PlannedRun& run, const Binding& binding,
                                      const TranslateOptions& options) {
  auto graph = plan_graph(run, binding, options.sequential);
  if (!graph) return result::forward(graph);
  ExpectedChanges changes = expected_changes(run, binding, start_offsets(run, options));
  SensorProgramOptions sensing;
  sensing.interval_us = options.interval_us;
  sensing.tare = options.tare;
  std::vector<ActionConditions> conditions;
  for (std::size_t i = 0; i < run.actions.size(); ++i) {
    auto next = action_conditions(run.actions[i], binding, options.tare, changes.before[i]);
    if (!next) return result::forward(next);
    sensing.values.insert(next->guard.values.begin(), next->guard.values.end());
    conditions.push_back(std::move(*next));
  }
  Translation translation;
  translation.initial = measured_start(run, options);
  const Condition snapshot = snapshot_condition(translation.initial, binding, options.tare);
  PlanChart chart(run, binding, *graph, conditions, snapshot, options.monitors);
  chart.build();
  if (!chart.writer().problems().empty()) return tl::unexpected(chart.writer().problems());
  translation.program = kPlanProgram;
  translation.instance = kPlanInstance;
  translation.steps = chart.writer().take_steps();
  translation.orderings = graph->orderings();
  translation.changes = std::move(changes.of_action);
  for (ActionConditions& each : conditions) translation.guards.push_back(std::move(each.guard.condition));
  translation.project = make_project(binding, sensing, chart.writer().take_chart());
  if (!options.monitors) return translation;
  if (auto added = add_monitors(translation, run, binding, options.tare); !added)
    return result::forward(added);
  return translation;
}

model::NamedState expected_state(const Translation& translation, const std::vector<bool>& done) {
  model::NamedState state = translation.initial;
  // Plan order, so that facts that are made and unmade again come out right.
  for (std::size_t i = 0; i < translation.changes.size(); ++i) {
    if (done[i]) apply(translation.changes[i], state);
  }
  return state;
}

}  // namespace stepwright::translate

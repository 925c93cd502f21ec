#include "ladder/graphic/sfc_reach.h"

#include <algorithm>
#include <utility>

#include "ladder/graphic/sfc_codes.h"

namespace stepwright::graphic {
namespace {

using result::Severity;

class Reach {
 public:
  Reach(const SfcChart& chart, const TokenNet& net, const MarkingGraph& graph, result::Diagnostics& out)
      : chart_(chart),
        out_(out),
        fires_(chart.transitions.size(), false),
        shut_out_(fires_.size(), true),
        reached_(chart.steps.size(), false),
        leaving_(chart.steps.size()),
        has_entry_(chart.steps.size(), false) {
    for (const Transition& each : chart.transitions) {
      for (const StepId source : each.sources) leaving_[source.value].push_back(&each);
      for (const StepId target : each.targets) {
        const bool loop = std::find(each.sources.begin(), each.sources.end(), target) != each.sources.end();
        if (!loop) has_entry_[target.value] = true;
      }
    }
    for (const NetTransition& each : net.transitions) shut_out_[each.origin] = false;
    for (const std::uint32_t place : net.marked) reached_[place] = true;
    graph.complete ? exactly(net, graph) : at_most(net);
  }

  void report() {
    explained_.assign(chart_.steps.size(), false);
    for (std::uint32_t t = 0; t < fires_.size(); ++t) {
      if (fires_[t] || !all(chart_.transitions[t].sources, reached_)) continue;
      transition(t);
    }
    // Where trouble begins with a step: one that nothing leads to, then a loop that nothing leads into.
    for (const bool orphans : {true, false}) {
      for (std::uint32_t s = 0; s < reached_.size(); ++s) {
        if (reached_[s] || explained_[s] || (orphans && has_entry_[s])) continue;
        add(code::kStepUnreachable, chart_.steps[s].where,
            "step '" + chart_.steps[s].name + "' can never become active",
            "no sequence of transitions leads to it");
        explain(s);
      }
    }
  }

 private:
  void add(const char* code, const result::Location& where, std::string message, std::string hint) {
    out_.push_back({code, Severity::Warning, where, std::move(message), std::move(hint)});
  }

  static bool all(const std::vector<StepId>& steps, const std::vector<bool>& set) {
    return std::all_of(steps.begin(), steps.end(), [&](StepId id) { return set[id.value]; });
  }

  void exactly(const TokenNet& net, const MarkingGraph& graph) {
    for (const auto& edges : graph.edges) {
      for (const MarkingEdge& edge : edges) fire(net.transitions[edge.transition]);
    }
  }

  void at_most(const TokenNet& net) {
    std::vector<std::vector<const NetTransition*>> waiting(reached_.size());
    for (const NetTransition& each : net.transitions)
      for (const std::uint32_t place : each.sources) waiting[place].push_back(&each);
    std::vector<std::uint32_t> open = net.marked;
    while (!open.empty()) {
      const std::uint32_t place = open.back();
      open.pop_back();
      for (const NetTransition* each : waiting[place]) {
        if (fires_[each->origin] || !all(chart_.transitions[each->origin].sources, reached_)) continue;
        for (const std::uint32_t target : each->targets)
          if (!reached_[target]) open.push_back(target);
        fire(*each);
      }
    }
  }

  void fire(const NetTransition& transition) {
    fires_[transition.origin] = true;
    for (const std::uint32_t place : transition.targets) reached_[place] = true;
  }

  void transition(std::uint32_t index) {
    const Transition& transition = chart_.transitions[index];
    std::string hint = shut_out_[index] ? "a transition with the condition TRUE goes before it"
                                        : "the steps before it are never active together";
    std::string steps;
    for (const StepId target : transition.targets) {
      if (reached_[target.value] || explained_[target.value]) continue;
      steps += (steps.empty() ? "'" : ", '") + chart_.steps[target.value].name + "'";
    }
    for (const StepId target : transition.targets) {
      if (!reached_[target.value]) explain(target.value);
    }
    if (!steps.empty()) hint += "; so step " + steps + " can never become active";
    add(code::kNeverFires, transition.where,
        "transition " + transition_label(chart_, index) + " can never fire", std::move(hint));
  }

  // Everything behind a step that was reported.
  void explain(std::uint32_t step) {
    std::vector<std::uint32_t> open{step};
    explained_[step] = true;
    while (!open.empty()) {
      const std::uint32_t from = open.back();
      open.pop_back();
      for (const Transition* each : leaving_[from]) {
        for (const StepId target : each->targets) {
          if (reached_[target.value] || explained_[target.value]) continue;
          explained_[target.value] = true;
          open.push_back(target.value);
        }
      }
    }
  }

  const SfcChart& chart_;
  result::Diagnostics& out_;
  std::vector<bool> fires_;
  std::vector<bool> shut_out_;  // by a transition that always goes before it
  std::vector<bool> reached_;
  std::vector<std::vector<const Transition*>> leaving_;  // by step
  std::vector<bool> has_entry_;                          // by step: from another one
  std::vector<bool> explained_;                          // follows from what was reported
};

}  // namespace

std::string transition_label(const SfcChart& chart, std::uint32_t index) {
  const Transition& transition = chart.transitions[index];
  if (!transition.name.empty()) return "'" + transition.name + "'";
  const auto names = [&](const std::vector<StepId>& steps) {
    std::string text;
    for (const StepId id : steps) text += (text.empty() ? "" : " + ") + chart.steps[id.value].name;
    return text;
  };
  return names(transition.sources) + " -> " + names(transition.targets);
}

void find_unreachable(const SfcChart& chart, const TokenNet& net, const MarkingGraph& graph,
                      result::Diagnostics& out) {
  Reach(chart, net, graph, out).report();
}

}  // namespace stepwright::graphic

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
        reached_(chart.steps.size(), false) {
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
        if (reached_[s] || explained_[s] || (orphans && has_entry(s))) continue;
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
    for (bool grown = true; grown;) {
      grown = false;
      for (const NetTransition& each : net.transitions) {
        if (fires_[each.origin] || !all(chart_.transitions[each.origin].sources, reached_)) continue;
        fire(each);
        grown = true;
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

  bool has_entry(std::uint32_t step) const {
    return std::any_of(chart_.transitions.begin(), chart_.transitions.end(), [&](const Transition& each) {
      return std::find(each.targets.begin(), each.targets.end(), StepId(step)) != each.targets.end() &&
             std::find(each.sources.begin(), each.sources.end(), StepId(step)) == each.sources.end();
    });
  }

  // Everything behind a step that was reported.
  void explain(std::uint32_t step) {
    std::vector<std::uint32_t> open{step};
    explained_[step] = true;
    while (!open.empty()) {
      const StepId from(open.back());
      open.pop_back();
      for (const Transition& each : chart_.transitions) {
        if (std::find(each.sources.begin(), each.sources.end(), from) == each.sources.end()) continue;
        for (const StepId target : each.targets) {
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
  std::vector<bool> explained_;  // follows from what was reported
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

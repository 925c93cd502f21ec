#include "ladder/graphic/sfc_hazards.h"

#include <algorithm>
#include <string>
#include <utility>

#include "ladder/graphic/marking_graph.h"
#include "ladder/graphic/sfc_codes.h"
#include "ladder/graphic/sfc_reach.h"
#include "ladder/graphic/token_net.h"

namespace stepwright::graphic {
namespace {

using result::Diagnostics;
using result::Severity;

constexpr std::size_t kShownSteps = 6;  // of a way to a situation

// The findings of one explored net.
class Findings {
 public:
  Findings(const SfcChart& chart, const TokenNet& net, const MarkingGraph& graph, Diagnostics& out)
      : chart_(chart), net_(net), graph_(graph), out_(out), has_exit_(net.places, false) {
    for (const NetTransition& each : net_.transitions) {
      for (const std::uint32_t place : each.sources) has_exit_[place] = true;
    }
  }

  void overruns() {
    for (const Overrun& each : graph_.overruns) {
      const Transition& transition = chart_.transitions[origin(each.transition)];
      add(code::kTokenDoubled, transition.where,
          "step '" + chart_.steps[each.place].name + "' can be entered while it is active (unsafe chart)",
          way(each.marking, "transition " + label(each.transition) + " enters it a second time") +
              "; leave simultaneous branches together, by one transition FROM all of them");
    }
  }

  // Tokens that are lost, and deadlocks. After a step was entered twice a token more or less is no new
  // mistake, but that the chart stops is; `whole`: the net is that of the chart, so this is certain too.
  void waits(bool whole) {
    const std::vector<PlaceSet> leave = places_to_leave(net_, graph_);
    const std::vector<bool> sound = without_overrun();
    std::vector<bool> reported(net_.places, false);
    std::vector<bool> dead(net_.places, false);
    for (const bool safe : {true, false}) {
      for (std::uint32_t m = 0; m < graph_.markings.size(); ++m) {
        if (sound[m] != safe || (!safe && !whole)) continue;
        bool others = false;
        const std::vector<std::uint32_t> stuck = stuck_in(m, leave[m], others);
        for (const std::uint32_t place : stuck) {
          if (safe && others && !reported[place]) lost(m, place);
          reported[place] = true;
        }
        const bool fresh =
            std::any_of(stuck.begin(), stuck.end(), [&](std::uint32_t place) { return !dead[place]; });
        if (others || !fresh) continue;
        for (const std::uint32_t place : stuck) dead[place] = true;
        deadlock(m, stuck);
      }
    }
  }

 private:
  void add(const char* code, const result::Location& where, std::string message, std::string hint) {
    out_.push_back({code, Severity::Warning, where, std::move(message), std::move(hint)});
  }

  // Active steps that have a way out but can never be left; `others`: there are steps that can be, or ends.
  std::vector<std::uint32_t> stuck_in(std::uint32_t marking, const PlaceSet& leave, bool& others) const {
    std::vector<std::uint32_t> stuck;
    for (std::uint32_t place = 0; place < net_.places; ++place) {
      if (!contains(graph_.markings[marking], place)) continue;
      if (has_exit_[place] && !contains(leave, place)) {
        stuck.push_back(place);
      } else {
        others = true;
      }
    }
    return stuck;
  }

  std::uint32_t origin(std::uint32_t transition) const { return net_.transitions[transition].origin; }
  std::string label(std::uint32_t transition) const { return transition_label(chart_, origin(transition)); }

  // "after T1, T2, T3 ..."
  std::string way(std::uint32_t marking, const std::string& then) const {
    const std::vector<std::vector<std::uint32_t>> path = way_to(graph_, marking);
    if (path.empty()) return "at the start " + then;
    std::string text = "for example after ";
    const std::size_t first = path.size() > kShownSteps ? path.size() - kShownSteps : 0;
    if (first > 0) text += "..., ";
    for (std::size_t i = first; i < path.size(); ++i) {
      text += i > first ? ", " : "";
      for (std::size_t k = 0; k < path[i].size(); ++k) text += (k > 0 ? " with " : "") + label(path[i][k]);
    }
    return text + " " + then;
  }

  // Which markings can be met before any step was entered twice: what comes after is no new mistake.
  std::vector<bool> without_overrun() const {
    std::vector<bool> sound(graph_.markings.size(), false);
    std::vector<std::uint32_t> open{0};
    sound[0] = true;
    while (!open.empty()) {
      const std::uint32_t from = open.back();
      open.pop_back();
      for (const MarkingEdge& edge : graph_.edges[from]) {
        if (edge.overrun || sound[edge.to]) continue;
        sound[edge.to] = true;
        open.push_back(edge.to);
      }
    }
    return sound;
  }

  // "transition JOIN waits for 'B'": what a step misses that will never come.
  std::string missing(std::uint32_t marking, std::uint32_t place) const {
    for (const NetTransition& each : net_.transitions) {
      if (!std::binary_search(each.sources.begin(), each.sources.end(), place)) continue;
      for (const std::uint32_t source : each.sources) {
        if (contains(graph_.markings[marking], source)) continue;
        return "transition " + transition_label(chart_, each.origin) + " waits for step '" +
               chart_.steps[source].name + "'";
      }
    }
    return "nothing leads on";
  }

  void lost(std::uint32_t marking, std::uint32_t place) {
    const Step& step = chart_.steps[place];
    add(code::kTokenLost, step.where,
        "a token can be lost: step '" + step.name + "' can stay active for ever while the rest goes on",
        way(marking, missing(marking, place)) + "; a simultaneous branch must not be left by a part of it");
  }

  void deadlock(std::uint32_t marking, const std::vector<std::uint32_t>& stuck) {
    std::string names;
    for (const std::uint32_t place : stuck)
      names += (names.empty() ? "'" : ", '") + chart_.steps[place].name + "'";
    const std::string what = stuck.size() == 1 ? "step " : "steps ";
    add(code::kDeadlock, chart_.steps[stuck.front()].where,
        "deadlock: the chart can stop for ever in " + what + names,
        way(marking, missing(marking, stuck.front())) +
            "; a convergence of simultaneous branches needs a divergence that starts all of them");
  }

  const SfcChart& chart_;
  const TokenNet& net_;
  const MarkingGraph& graph_;
  Diagnostics& out_;
  std::vector<bool> has_exit_;  // by place
};

}  // namespace

Diagnostics find_hazards(const SfcChart& chart, const HazardOptions& options) {
  Diagnostics found;
  TokenNet net = token_net(chart);
  MarkingGraph graph = explore(net, std::max<std::size_t>(options.marking_limit / 4, 1));
  find_unreachable(chart, net, graph, found);
  const bool whole = graph.complete;
  if (!whole) {
    net = reduced(std::move(net));
    graph = explore(net, options.marking_limit);
  }
  Findings findings(chart, net, graph, found);
  findings.overruns();
  if (graph.complete) {
    findings.waits(whole);
  } else {
    found.push_back({code::kSearchCut, Severity::Note, chart.steps.front().where,
                     "the chart has more than " + std::to_string(options.marking_limit) +
                         " situations; only these were searched for tokens that are lost or doubled",
                     "nothing found is no proof here"});
  }
  return found;
}

}  // namespace stepwright::graphic

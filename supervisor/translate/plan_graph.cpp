#include "supervisor/translate/plan_graph.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <string>
#include <utility>

namespace stepwright::translate {

namespace {

// reach[i] holds a bit for every node that i leads to.
class Reach {
 public:
  explicit Reach(std::size_t size) : words_((size + 63) / 64), bits_(size * words_, 0) {}

  bool has(std::size_t from, std::size_t to) const {
    return (bits_[from * words_ + to / 64] >> (to % 64) & 1U) != 0;
  }
  void add(std::size_t from, std::size_t to) {
    bits_[from * words_ + to / 64] |= std::uint64_t{1} << to % 64;
  }
  void add_all(std::size_t from, std::size_t through) {
    for (std::size_t w = 0; w < words_; ++w) bits_[from * words_ + w] |= bits_[through * words_ + w];
  }

 private:
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

// What each node reaches over `edges`, which lead to larger indices.
Reach reach_of(std::size_t size, const std::vector<model::Ordering>& edges) {
  std::vector<std::vector<std::size_t>> next(size);
  for (const model::Ordering& edge : edges) next[edge.before].push_back(edge.after);
  Reach reach(size);
  for (std::size_t i = size; i-- > 0;) {
    for (const std::size_t j : next[i]) {
      reach.add(i, j);
      reach.add_all(i, j);
    }
  }
  return reach;
}

std::vector<model::Ordering> chain(std::size_t size) {
  std::vector<model::Ordering> edges;
  for (std::size_t i = 1; i < size; ++i) edges.push_back({i - 1, i});
  return edges;
}

using Outputs = std::vector<std::string>;

bool contains(const Outputs& outputs, const std::string& name) {
  return std::find(outputs.begin(), outputs.end(), name) != outputs.end();
}

bool touches(const Outputs& outputs, const Outputs& group) {
  return std::any_of(outputs.begin(), outputs.end(), [&](const auto& name) { return contains(group, name); });
}

// Outputs for which `a` and `b` cannot be driven at the same time; none if they can.
Outputs conflict(const Outputs& a, const Outputs& b, const Binding& binding) {
  Outputs shared;
  for (const std::string& name : a) {
    if (contains(b, name)) shared.push_back(name);
  }
  for (const Outputs& group : binding.exclusive) {
    if (!touches(a, group) || !touches(b, group)) continue;
    for (const std::string& name : group) {
      if ((contains(a, name) || contains(b, name)) && !contains(shared, name)) shared.push_back(name);
    }
  }
  return shared;
}

const Outputs& outputs_of(const model::PlannedAction& planned, const Binding& binding) {
  Assignment assignment;
  return binding.action_for(planned.action, assignment)->outputs;
}

}  // namespace

std::vector<model::Ordering> PlanGraph::orderings() const {
  std::vector<model::Ordering> edges;
  for (std::size_t i = 0; i < size(); ++i) {
    for (const std::size_t j : successors[i]) edges.push_back({i, j});
  }
  return edges;
}

PlanGraph reduced_graph(std::size_t size, const std::vector<model::Ordering>& edges) {
  PlanGraph graph{std::vector<std::vector<std::size_t>>(size), std::vector<std::vector<std::size_t>>(size)};
  const Reach reach = reach_of(size, edges);
  for (const model::Ordering& edge : edges) {
    assert(edge.before < edge.after && edge.after < size);
    bool direct = true;
    for (std::size_t k = edge.before + 1; direct && k < edge.after; ++k) {
      direct = !(reach.has(edge.before, k) && reach.has(k, edge.after));
    }
    auto& next = graph.successors[edge.before];
    if (!direct || std::find(next.begin(), next.end(), edge.after) != next.end()) continue;
    next.push_back(edge.after);
    graph.predecessors[edge.after].push_back(edge.before);
  }
  for (auto& list : graph.successors) std::sort(list.begin(), list.end());
  for (auto& list : graph.predecessors) std::sort(list.begin(), list.end());
  return graph;
}

std::vector<Exclusion> exclusions(const model::PlannedRun& run, const Binding& binding) {
  const std::size_t size = run.actions.size();
  const Reach reach = reach_of(size, run.orderings.value_or(chain(size)));
  std::vector<Exclusion> pairs;
  for (std::size_t j = 1; j < size; ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      if (reach.has(i, j)) continue;
      Outputs outputs =
          conflict(outputs_of(run.actions[i], binding), outputs_of(run.actions[j], binding), binding);
      if (!outputs.empty()) pairs.push_back({i, j, std::move(outputs)});
    }
  }
  return pairs;
}

result::Result<PlanGraph> plan_graph(const model::PlannedRun& run, const Binding& binding, bool sequential) {
  const std::size_t size = run.actions.size();
  for (const model::PlannedAction& planned : run.actions) {
    Assignment assignment;
    if (binding.action_for(planned.action, assignment) != nullptr) continue;
    return result::fail("T0001", {binding.file, 0, 0},
                        "no entry of the binding matches " + to_string(planned.action),
                        "add an [[actions]] entry whose pattern fits it");
  }
  std::vector<model::Ordering> edges = run.orderings.value_or(chain(size));
  for (const model::Ordering& edge : edges) {
    if (edge.before < edge.after && edge.after < size) continue;
    return result::fail("T0002", {},
                        "the ordering " + std::to_string(edge.before) + " before " +
                            std::to_string(edge.after) + " contradicts the plan's list of " +
                            std::to_string(size) + " actions");
  }
  if (sequential) return reduced_graph(size, chain(size));
  for (const Exclusion& pair : exclusions(run, binding)) edges.push_back({pair.first, pair.second});
  return reduced_graph(size, edges);
}

}  // namespace stepwright::translate

#include "supervisor/ltl/automaton/emptiness.h"

#include <algorithm>
#include <map>

namespace stepwright::ltl {

namespace {

using Obligations = std::vector<Term>;  // sorted

constexpr std::size_t kDeepest = 2'000;  // obligations of a set: they are settled one within the other

class Graph {
 public:
  Graph(Progression& progression, std::size_t most_edges)
      : progression_(progression), most_edges_(most_edges) {}

  // The sets that satisfy a state.
  std::vector<std::uint32_t> sets_of(Progression::State state) {
    std::vector<std::uint32_t> found;
    path_.clear();
    each_path(state, [&] { found.push_back(node(path_)); });
    return found;
  }

  void explore() {
    for (std::uint32_t from = 0; from < sets_.size() && !failed_; ++from) {
      const Obligations set = sets_[from];
      settle(from, set, 0, Diagram::kTrue, 0);
      if (progression_.exhausted()) failed_ = true;
    }
  }

  bool failed() const { return failed_; }

  // Of each node: whether a fair cycle can be reached.
  std::vector<bool> live() const {
    const std::vector<std::uint32_t> component = components();
    const std::size_t count = sets_.size();
    std::vector<std::uint64_t> open(count,
                                    ~std::uint64_t{0});  // of each component: Untils that no edge settles
    std::vector<bool> cyclic(count, false);
    for (std::uint32_t k = 0; k < count; ++k) {
      for (const Edge& edge : edges_[k]) {
        if (component[edge.to] != component[k]) continue;
        cyclic[component[k]] = true;
        open[component[k]] &= edge.taken_along;
      }
    }
    // Components are numbered against their edges: what is behind comes first.
    std::vector<bool> good(count, false), result(count, false);
    std::vector<std::vector<std::uint32_t>> members(count);
    for (std::uint32_t k = 0; k < count; ++k) members[component[k]].push_back(k);
    for (std::uint32_t c = 0; c < count; ++c) {
      good[c] = cyclic[c] && open[c] == 0;
      for (const std::uint32_t k : members[c])
        for (const Edge& edge : edges_[k])
          if (component[edge.to] != c && good[component[edge.to]]) good[c] = true;
    }
    for (std::uint32_t k = 0; k < count; ++k) result[k] = good[component[k]];
    return result;
  }

 private:
  struct Edge {
    std::uint32_t to = 0;
    std::uint64_t taken_along = 0;
  };

  std::uint32_t node(Obligations set) {
    std::ranges::sort(set);
    const auto [known, added] = ids_.emplace(set, static_cast<std::uint32_t>(sets_.size()));
    if (added) {
      sets_.push_back(std::move(set));
      edges_.emplace_back();
    }
    return known->second;
  }

  // Each way to make a function true; letters may be anything that fits, obligations of the way are in path_.
  template <typename Found>
  void each_path(Diagram::Node function, const Found& found) {
    if (function == Diagram::kFalse || failed_) return;
    if (function == Diagram::kTrue) {
      if (++paths_ > most_edges_) failed_ = true;
      found();
      return;
    }
    const Diagram& diagram = progression_.diagram();
    const bool obliges = progression_.is_state(function);
    if (++depth_ > kDeepest) failed_ = true;
    each_path(diagram.low(function), found);
    if (obliges) path_.push_back(progression_.obligation(function));
    each_path(diagram.high(function), found);
    if (obliges) path_.pop_back();
    --depth_;
  }

  std::uint64_t bit(Term until) {
    const auto [known, added] = untils_.emplace(until, untils_.size());
    if (known->second >= 64) failed_ = true;
    return std::uint64_t{1} << (known->second & 63);
  }

  // Edges of a set: obligations from the k-th on are still to be looked at.
  void settle(std::uint32_t from, const Obligations& set, std::size_t k, Diagram::Node together,
              std::uint64_t along) {
    if (set.size() > kDeepest) failed_ = true;
    if (together == Diagram::kFalse || failed_) return;
    Diagram& diagram = progression_.diagram();
    if (k == set.size()) {
      path_.clear();
      each_path(together, [&] {
        const std::uint32_t to = node(path_);
        edges_[from].push_back({to, along});
      });
      return;
    }
    const Terms& terms = progression_.terms();
    if (terms.kind(set[k]) != TermKind::Until) {
      settle(from, set, k + 1, diagram.both(together, progression_.change(set[k])), along);
      return;
    }
    const Term left = terms.operands(set[k])[0], right = terms.operands(set[k])[1];
    settle(from, set, k + 1, diagram.both(together, progression_.change(right)), along);
    const Diagram::Node again = diagram.both(progression_.change(left), progression_.unchanged(set[k]));
    settle(from, set, k + 1, diagram.both(together, again), along | bit(set[k]));
  }

  // R. Tarjan's strongly connected components, without recursion.
  std::vector<std::uint32_t> components() const {
    constexpr std::uint32_t kNone = 0xFFFFFFFF;
    const std::size_t count = sets_.size();
    std::vector<std::uint32_t> order(count, kNone), lowest(count, 0), component(count, kNone), stack;
    std::vector<std::pair<std::uint32_t, std::size_t>> calls;
    std::uint32_t met = 0, made = 0;
    for (std::uint32_t root = 0; root < count; ++root) {
      if (order[root] != kNone) continue;
      calls.emplace_back(root, 0);
      while (!calls.empty()) {
        const std::uint32_t at = calls.back().first;
        if (calls.back().second == 0 && order[at] == kNone) {
          order[at] = lowest[at] = met++;
          stack.push_back(at);
        }
        if (calls.back().second < edges_[at].size()) {
          const std::uint32_t to = edges_[at][calls.back().second++].to;
          if (order[to] == kNone) {
            calls.emplace_back(to, 0);
          } else if (component[to] == kNone) {
            lowest[at] = std::min(lowest[at], order[to]);
          }
          continue;
        }
        if (lowest[at] == order[at]) {
          for (std::uint32_t member = kNone; member != at; stack.pop_back())
            component[member = stack.back()] = made;
          ++made;
        }
        calls.pop_back();
        if (!calls.empty()) lowest[calls.back().first] = std::min(lowest[calls.back().first], lowest[at]);
      }
    }
    return component;
  }

  Progression& progression_;
  std::size_t most_edges_, paths_ = 0, depth_ = 0;
  bool failed_ = false;
  Obligations path_;
  std::map<Obligations, std::uint32_t> ids_;
  std::map<Term, std::size_t> untils_;
  std::vector<Obligations> sets_;
  std::vector<std::vector<Edge>> edges_;
};

}  // namespace

std::optional<std::vector<bool>> satisfiable(Progression& progression,
                                             const std::vector<Progression::State>& states,
                                             std::size_t most_edges) {
  Graph graph(progression, most_edges);
  std::vector<std::vector<std::uint32_t>> sets;
  for (const Progression::State state : states) sets.push_back(graph.sets_of(state));
  graph.explore();
  if (graph.failed() || progression.exhausted()) return std::nullopt;
  const std::vector<bool> live = graph.live();
  std::vector<bool> answers;
  for (const auto& each : sets)
    answers.push_back(std::ranges::any_of(each, [&](std::uint32_t set) { return live[set]; }));
  return answers;
}

}  // namespace stepwright::ltl

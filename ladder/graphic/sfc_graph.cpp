#include "ladder/graphic/sfc_graph.h"

#include <algorithm>
#include <set>
#include <utility>

namespace stepwright::graphic {
namespace {

using Edge = std::pair<std::size_t, std::size_t>;

// Nodes 0..S-1 are the steps, S..S+T-1 the transitions.
class Builder {
 public:
  explicit Builder(const SfcChart& chart) : chart_(chart), steps_(chart.steps.size()) {
    graph_.nodes.resize(steps_ + chart.transitions.size());
    graph_.jumps_into.resize(steps_);
    successors_.resize(graph_.nodes.size());
    predecessors_.resize(graph_.nodes.size());
    for (std::size_t i = 0; i < steps_; ++i) {
      graph_.nodes[i].kind = NodeKind::Step;
      graph_.nodes[i].index = static_cast<std::uint32_t>(i);
    }
    for (std::size_t t = 0; t < chart.transitions.size(); ++t) {
      const std::size_t node = steps_ + t;
      graph_.nodes[node].kind = NodeKind::Transition;
      graph_.nodes[node].index = static_cast<std::uint32_t>(t);
      for (const StepId id : chart.transitions[t].sources) connect(id.value, node);
      for (const StepId id : chart.transitions[t].targets) connect(node, id.value);
    }
  }

  LayeredGraph build() {
    find_loops();
    assign_layers();
    join();
    fill_layers();
    return std::move(graph_);
  }

 private:
  void connect(std::size_t from, std::size_t to) {
    successors_[from].push_back(to);
    predecessors_[to].push_back(from);
  }

  // Depth-first from the initial steps: an edge from a transition back to a step on the path is a jump.
  void find_loops() {
    std::vector<char> state(graph_.nodes.size(), 0);  // 0 new, 1 on the path, 2 done
    for (const bool initial : {true, false}) {
      for (std::size_t i = 0; i < steps_; ++i) {
        if (state[i] == 0 && chart_.steps[i].initial == initial) search(i, state);
      }
    }
  }

  void search(std::size_t root, std::vector<char>& state) {
    std::vector<Edge> path{{root, 0}};  // node, next successor
    state[root] = 1;
    while (!path.empty()) {
      auto& [node, next] = path.back();
      if (next == successors_[node].size()) {
        state[node] = 2;
        path.pop_back();
        continue;
      }
      const std::size_t to = successors_[node][next++];
      if (state[to] == 1 && to < steps_) jumps_.insert({node, to});
      if (state[to] != 0) continue;
      state[to] = 1;
      path.emplace_back(to, 0);
    }
  }

  // Longest path from the top. What hangs in a loop that the search left whole (one through a convergence) is
  // cut at a step.
  void assign_layers() {
    std::vector<bool> placed(graph_.nodes.size(), false);
    for (std::size_t done = 0; done < placed.size();) {
      std::vector<std::size_t> ready;
      for (std::size_t node = 0; node < placed.size(); ++node) {
        if (!placed[node] && is_ready(node, placed)) ready.push_back(node);
      }
      if (ready.empty()) ready.push_back(cut(placed));
      for (const std::size_t node : ready) place(node, placed);
      done += ready.size();
    }
  }

  bool is_ready(std::size_t node, const std::vector<bool>& placed) const {
    return std::all_of(predecessors_[node].begin(), predecessors_[node].end(), [&](std::size_t from) {
      return placed[from] || jumps_.count({from, node}) != 0;
    });
  }

  std::size_t cut(const std::vector<bool>& placed) {
    std::size_t best = steps_;
    int best_score = -1;
    for (std::size_t i = 0; i < steps_; ++i) {
      if (placed[i]) continue;
      const bool follows = std::any_of(predecessors_[i].begin(), predecessors_[i].end(),
                                       [&](std::size_t from) { return placed[from]; });
      const int score = (chart_.steps[i].initial ? 2 : 0) + (follows ? 1 : 0);
      if (score > best_score) best = i;
      best_score = std::max(best_score, score);
    }
    for (const std::size_t from : predecessors_[best]) {
      if (!placed[from]) jumps_.insert({from, best});
    }
    return best;
  }

  void place(std::size_t node, std::vector<bool>& placed) {
    std::size_t layer = 0;
    for (const std::size_t from : predecessors_[node]) {
      if (jumps_.count({from, node}) == 0) layer = std::max(layer, graph_.nodes[from].layer + 1);
    }
    graph_.nodes[node].layer = layer;
    placed[node] = true;
  }

  std::size_t add(NodeKind kind, std::size_t index, std::size_t layer) {
    LayoutNode node;
    node.kind = kind;
    node.index = static_cast<std::uint32_t>(index);
    node.layer = layer;
    graph_.nodes.push_back(std::move(node));
    return graph_.nodes.size() - 1;
  }

  void link(std::size_t from, std::size_t to) {
    graph_.nodes[from].down.push_back(to);
    graph_.nodes[to].up.push_back(from);
  }

  void join() {
    const std::size_t originals = successors_.size();
    for (std::size_t from = 0; from < originals; ++from) {
      for (const std::size_t to : successors_[from]) {
        if (jumps_.count({from, to}) != 0) {
          graph_.jumps_into[to].push_back(graph_.nodes[from].index);
          link(from, add(NodeKind::Jump, to, graph_.nodes[from].layer + 1));
          continue;
        }
        std::size_t last = from;
        for (std::size_t layer = graph_.nodes[from].layer + 1; layer < graph_.nodes[to].layer; ++layer) {
          const std::size_t pass = add(NodeKind::Pass, 0, layer);
          link(last, pass);
          last = pass;
        }
        link(last, to);
      }
    }
  }

  // First order: depth-first from the left, so that what belongs together stands together.
  void fill_layers() {
    std::size_t layers = 0;
    for (const LayoutNode& node : graph_.nodes) layers = std::max(layers, node.layer + 1);
    graph_.layers.resize(layers);
    std::vector<bool> seen(graph_.nodes.size(), false);
    for (std::size_t root = 0; root < graph_.nodes.size(); ++root) {
      std::vector<std::size_t> stack{root};
      while (!stack.empty()) {
        const std::size_t node = stack.back();
        stack.pop_back();
        if (seen[node]) continue;
        seen[node] = true;
        graph_.layers[graph_.nodes[node].layer].push_back(node);
        const std::vector<std::size_t>& down = graph_.nodes[node].down;
        stack.insert(stack.end(), down.rbegin(), down.rend());
      }
    }
  }

  const SfcChart& chart_;
  std::size_t steps_;
  LayeredGraph graph_;
  std::vector<std::vector<std::size_t>> successors_;
  std::vector<std::vector<std::size_t>> predecessors_;
  std::set<Edge> jumps_;
};

}  // namespace

LayeredGraph layered_graph(const SfcChart& chart) {
  return Builder(chart).build();
}

}  // namespace stepwright::graphic

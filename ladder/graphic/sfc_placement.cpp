#include "ladder/graphic/sfc_placement.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace stepwright::graphic {
namespace {

constexpr int sweeps = 24;

std::vector<std::size_t> positions(const LayeredGraph& graph) {
  std::vector<std::size_t> position(graph.nodes.size(), 0);
  for (const std::vector<std::size_t>& layer : graph.layers) {
    for (std::size_t i = 0; i < layer.size(); ++i) position[layer[i]] = i;
  }
  return position;
}

std::size_t crossings(const LayeredGraph& graph) {
  const std::vector<std::size_t> position = positions(graph);
  std::size_t count = 0;
  for (const std::vector<std::size_t>& layer : graph.layers) {
    for (std::size_t a = 0; a < layer.size(); ++a) {
      for (std::size_t b = a + 1; b < layer.size(); ++b) {
        for (const std::size_t i : graph.nodes[layer[a]].down) {
          for (const std::size_t j : graph.nodes[layer[b]].down) count += position[i] > position[j] ? 1U : 0U;
        }
      }
    }
  }
  return count;
}

void sort_layer(LayeredGraph& graph, std::size_t layer, bool by_upper) {
  const std::vector<std::size_t> position = positions(graph);
  std::vector<double> mean(graph.nodes.size(), 0);
  for (const std::size_t node : graph.layers[layer]) {
    const std::vector<std::size_t>& near = by_upper ? graph.nodes[node].up : graph.nodes[node].down;
    for (const std::size_t other : near) mean[node] += static_cast<double>(position[other]);
    // A node without neighbours on that side keeps its place.
    mean[node] =
        near.empty() ? static_cast<double>(position[node]) : mean[node] / static_cast<double>(near.size());
  }
  std::stable_sort(graph.layers[layer].begin(), graph.layers[layer].end(),
                   [&](std::size_t a, std::size_t b) { return mean[a] < mean[b]; });
}

// Positions of the nodes of one layer with the least weighted squared distance from what they want, in order
// and with their distances kept (isotonic regression by pooling neighbours).
class LayerSolver {
 public:
  LayerSolver(const LayeredGraph& graph, const std::vector<std::size_t>& layer, int gap) {
    offset_.push_back(0);
    for (std::size_t i = 1; i < layer.size(); ++i) {
      offset_.push_back(offset_.back() + graph.nodes[layer[i - 1]].right + gap + graph.nodes[layer[i]].left);
    }
  }

  std::vector<double> solve(const std::vector<double>& wanted, const std::vector<double>& weight) const {
    struct Pool {
      double sum;
      double weight;
      std::size_t count;
      double mean() const { return sum / weight; }
    };
    std::vector<Pool> pools;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      pools.push_back({(wanted[i] - offset_[i]) * weight[i], weight[i], 1});
      while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
        const Pool last = pools.back();
        pools.pop_back();
        pools.back().sum += last.sum;
        pools.back().weight += last.weight;
        pools.back().count += last.count;
      }
    }
    std::vector<double> result;
    for (const Pool& pool : pools) {
      for (std::size_t i = 0; i < pool.count; ++i) result.push_back(pool.mean() + offset_[result.size()]);
    }
    return result;
  }

 private:
  std::vector<double> offset_;
};

class Placement {
 public:
  Placement(LayeredGraph& graph, int gap)
      : graph_(graph), gap_(gap), x_(graph.nodes.size(), 0), height_(graph.nodes.size(), 0) {
    for (std::size_t layer = graph_.layers.size(); layer-- > 0;) {
      for (const std::size_t node : graph_.layers[layer]) {
        for (const std::size_t lower : graph_.nodes[node].down) {
          height_[node] = std::max(height_[node], height_[lower] + 1);
        }
      }
    }
  }

  void run() {
    for (std::size_t layer = 0; layer < graph_.layers.size(); ++layer) relax(layer, true, false);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (std::size_t layer = 0; layer < graph_.layers.size(); ++layer) relax(layer, true, sweep > 8);
      for (std::size_t layer = graph_.layers.size(); layer-- > 0;) relax(layer, sweep > 8, true);
    }
    round();
    for (int pass = 0; pass < 3; ++pass) straighten();
    shift();
  }

 private:
  // Long lines pull harder, so that they stay straight; and so does a branch that goes on for long, so that
  // side branches (failures, short waits) do not push the main sequence aside.
  double pull(std::size_t upper, std::size_t lower) const {
    const int passes = (graph_.nodes[upper].kind == NodeKind::Pass ? 1 : 0) +
                       (graph_.nodes[lower].kind == NodeKind::Pass ? 1 : 0);
    const double straight = passes == 2 ? 8 : passes == 1 ? 2 : 1;
    const double goes_on = 1.0 + static_cast<double>(height_[lower]);
    return straight * goes_on * goes_on;
  }

  void relax(std::size_t layer, bool look_up, bool look_down) {
    const std::vector<std::size_t>& nodes = graph_.layers[layer];
    std::vector<double> wanted;
    std::vector<double> weight;
    for (const std::size_t node : nodes) {
      double sum = 0;
      double total = 0;
      const auto add = [&](std::size_t other, double force) {
        sum += force * x_[other];
        total += force;
      };
      if (look_up) {
        for (const std::size_t other : graph_.nodes[node].up) add(other, pull(other, node));
      }
      if (look_down) {
        for (const std::size_t other : graph_.nodes[node].down) add(other, pull(node, other));
      }
      wanted.push_back(total > 0 ? sum / total : x_[node]);
      weight.push_back(total > 0 ? total : 0.1);
    }
    const std::vector<double> solved = LayerSolver(graph_, nodes, gap_).solve(wanted, weight);
    for (std::size_t i = 0; i < nodes.size(); ++i) x_[nodes[i]] = solved[i];
  }

  void round() {
    for (const std::vector<std::size_t>& layer : graph_.layers) {
      for (std::size_t i = 0; i < layer.size(); ++i) {
        LayoutNode& node = graph_.nodes[layer[i]];
        node.x = static_cast<int>(std::lround(x_[layer[i]]));
        if (i == 0) continue;
        const LayoutNode& before = graph_.nodes[layer[i - 1]];
        node.x = std::max(node.x, before.x + before.right + gap_ + node.left);
      }
    }
  }

  // Removes the small steps that rounding and averaging left in lines.
  void straighten() {
    for (const std::vector<std::size_t>& layer : graph_.layers) {
      for (std::size_t i = 0; i < layer.size(); ++i) {
        LayoutNode& node = graph_.nodes[layer[i]];
        const bool only_line = node.up.size() == 1 && graph_.nodes[node.up[0]].down.size() == 1;
        for (const std::size_t upper : node.up) {
          const int wanted = graph_.nodes[upper].x;
          const bool near = std::abs(wanted - node.x) <= gap_ / 2;
          if ((only_line || near) && fits(layer, i, wanted)) node.x = wanted;
        }
      }
    }
  }

  bool fits(const std::vector<std::size_t>& layer, std::size_t i, int x) const {
    const LayoutNode& node = graph_.nodes[layer[i]];
    if (i > 0) {
      const LayoutNode& before = graph_.nodes[layer[i - 1]];
      if (x - node.left < before.x + before.right + gap_) return false;
    }
    if (i + 1 < layer.size()) {
      const LayoutNode& after = graph_.nodes[layer[i + 1]];
      if (x + node.right + gap_ > after.x - after.left) return false;
    }
    return true;
  }

  void shift() {
    int leftmost = std::numeric_limits<int>::max();
    for (const LayoutNode& node : graph_.nodes) leftmost = std::min(leftmost, node.x - node.left);
    for (LayoutNode& node : graph_.nodes) node.x -= leftmost;
  }

  LayeredGraph& graph_;
  int gap_;
  std::vector<double> x_;
  std::vector<std::size_t> height_;  // layers of the longest way down
};

}  // namespace

void order_layers(LayeredGraph& graph) {
  std::vector<std::vector<std::size_t>> best = graph.layers;
  std::size_t fewest = crossings(graph);
  for (int sweep = 0; sweep < sweeps && fewest > 0; ++sweep) {
    const bool down = sweep % 2 == 0;
    for (std::size_t i = 1; i < graph.layers.size(); ++i) {
      sort_layer(graph, down ? i : graph.layers.size() - 1 - i, down);
    }
    const std::size_t count = crossings(graph);
    if (count >= fewest) continue;
    fewest = count;
    best = graph.layers;
  }
  graph.layers = std::move(best);
}

void place_axes(LayeredGraph& graph, int gap) {
  Placement(graph, gap).run();
}

}  // namespace stepwright::graphic

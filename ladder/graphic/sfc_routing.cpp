#include "ladder/graphic/sfc_routing.h"

#include <algorithm>
#include <map>

namespace stepwright::graphic {
namespace {

class Router {
 public:
  Router(const LayeredGraph& graph, std::size_t layer, int overhang)
      : graph_(graph), layer_(layer), overhang_(overhang) {}

  Channel run() {
    for (const std::size_t upper : graph_.layers[layer_]) {
      for (const std::size_t lower : graph_.nodes[upper].down) connect(upper, lower);
    }
    for (ChannelLine& line : channel_.lines) {
      if (!line.doubled) continue;
      line.x1 -= overhang_;
      line.x2 += overhang_;
    }
    assign_tracks();
    return std::move(channel_);
  }

 private:
  std::size_t new_line(int x, bool doubled) {
    ChannelLine line;
    line.x1 = line.x2 = x;
    line.doubled = doubled;
    channel_.lines.push_back(line);
    return channel_.lines.size() - 1;
  }

  void reach(std::size_t line, int x) {
    channel_.lines[line].x1 = std::min(channel_.lines[line].x1, x);
    channel_.lines[line].x2 = std::max(channel_.lines[line].x2, x);
  }

  // The bar below a node that diverges; made with the first edge.
  std::size_t bar_below(std::size_t node) {
    const auto [found, is_new] = below_.try_emplace(node, channel_.lines.size());
    if (!is_new) return found->second;
    const int x = graph_.nodes[node].x;
    const std::size_t line = new_line(x, graph_.nodes[node].kind == NodeKind::Transition);
    channel_.lines[line].from_above.push_back(x);
    channel_.drops.push_back({x, ChannelDrop::layer, line});
    return line;
  }

  std::size_t bar_above(std::size_t node) {
    const auto [found, is_new] = above_.try_emplace(node, channel_.lines.size());
    if (!is_new) return found->second;
    const int x = graph_.nodes[node].x;
    const std::size_t line = new_line(x, graph_.nodes[node].kind == NodeKind::Transition);
    channel_.lines[line].to_below.push_back(x);
    channel_.drops.push_back({x, line, ChannelDrop::layer});
    return line;
  }

  void connect(std::size_t upper, std::size_t lower) {
    const int upper_x = graph_.nodes[upper].x;
    const int lower_x = graph_.nodes[lower].x;
    const bool diverges = graph_.nodes[upper].down.size() > 1;
    const bool converges = graph_.nodes[lower].up.size() > 1;
    if (diverges && converges) {
      const std::size_t from = bar_below(upper);
      const std::size_t to = bar_above(lower);
      const int x = (upper_x + lower_x) / 2;
      reach(from, x);
      reach(to, x);
      channel_.drops.push_back({x, from, to});
      above_pairs_.emplace_back(from, to);
    } else if (diverges) {
      leave(bar_below(upper), lower_x);
    } else if (converges) {
      arrive(bar_above(lower), upper_x);
    } else if (upper_x == lower_x) {
      channel_.drops.push_back({upper_x, ChannelDrop::layer, ChannelDrop::layer});
    } else {
      const std::size_t bend = new_line(upper_x, false);
      arrive(bend, upper_x);
      leave(bend, lower_x);
    }
  }

  void leave(std::size_t line, int x) {
    reach(line, x);
    channel_.lines[line].to_below.push_back(x);
    channel_.drops.push_back({x, line, ChannelDrop::layer});
  }

  void arrive(std::size_t line, int x) {
    reach(line, x);
    channel_.lines[line].from_above.push_back(x);
    channel_.drops.push_back({x, ChannelDrop::layer, line});
  }

  // Where a line is reached from above and another left downwards at the same x, the first must be higher.
  bool must_be_above(std::size_t a, std::size_t b) const {
    for (const auto& [from, to] : above_pairs_) {
      if (from == a && to == b) return true;
    }
    const std::vector<int>& tops = channel_.lines[a].from_above;
    const std::vector<int>& bottoms = channel_.lines[b].to_below;
    return a != b && std::any_of(tops.begin(), tops.end(), [&](int x) {
             return std::find(bottoms.begin(), bottoms.end(), x) != bottoms.end();
           });
  }

  // The left-edge algorithm of channel routing with vertical constraints.
  void assign_tracks() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < channel_.lines.size(); ++i) open.push_back(i);
    std::stable_sort(open.begin(), open.end(), [this](std::size_t a, std::size_t b) {
      return channel_.lines[a].x1 < channel_.lines[b].x1;
    });
    while (!open.empty()) {
      std::vector<std::size_t> row;
      for (const std::size_t line : open) {
        const bool free = std::none_of(open.begin(), open.end(), [&](std::size_t other) {
          return other != line && must_be_above(other, line);
        });
        if (free && (row.empty() || channel_.lines[row.back()].x2 + overhang_ < channel_.lines[line].x1)) {
          row.push_back(line);
        }
      }
      if (row.empty()) row.push_back(open.front());  // a cycle of constraints: give one of them up
      for (const std::size_t line : row) {
        channel_.lines[line].track = channel_.tracks;
        open.erase(std::find(open.begin(), open.end(), line));
      }
      ++channel_.tracks;
    }
  }

  const LayeredGraph& graph_;
  std::size_t layer_;
  int overhang_;
  Channel channel_;
  std::map<std::size_t, std::size_t> below_;  // diverging node -> line
  std::map<std::size_t, std::size_t> above_;  // converging node -> line
  std::vector<std::pair<std::size_t, std::size_t>> above_pairs_;
};

}  // namespace

Channel route_channel(const LayeredGraph& graph, std::size_t layer, int overhang) {
  return Router(graph, layer, overhang).run();
}

}  // namespace stepwright::graphic

#include "plant_models/components/layout.h"

#include <algorithm>

namespace stepwright::components {
namespace {

constexpr std::uint32_t kMostColumns = 12;

// What stands behind what: an edge that leads back to where it was is left away.
std::vector<std::uint32_t> columns_of(const Model& model) {
  const std::size_t count = model.names.size();
  std::vector<std::vector<std::uint32_t>> next(count);
  for (const ModelLink& link : model.links)
    if (link.from != link.to) next[link.from].push_back(link.to);
  std::vector<std::uint32_t> column(count, 0);
  std::vector<int> state(count, 0);  // 0 new, 1 on the way, 2 done
  std::vector<std::uint32_t> order;
  std::vector<std::pair<std::uint32_t, std::size_t>> path;
  for (std::uint32_t root = 0; root < count; ++root) {
    if (state[root] != 0) continue;
    path.push_back({root, 0});
    state[root] = 1;
    while (!path.empty()) {
      auto& [node, at] = path.back();
      if (at < next[node].size()) {
        const std::uint32_t to = next[node][at];
        if (state[to] == 1) {
          next[node].erase(next[node].begin() + static_cast<std::ptrdiff_t>(at));
          continue;
        }
        ++at;
        if (state[to] == 0) {
          state[to] = 1;
          path.push_back({to, 0});
        }
        continue;
      }
      state[node] = 2;
      order.push_back(node);
      path.pop_back();
    }
  }
  for (auto node = order.rbegin(); node != order.rend(); ++node)
    for (const std::uint32_t to : next[*node])
      column[to] = std::min(std::max(column[to], column[*node] + 1), kMostColumns - 1);
  return column;
}

}  // namespace

Layout lay_out(const Model& model) {
  const std::vector<std::uint32_t> column = columns_of(model);
  const std::size_t count = model.names.size();
  Layout layout;
  layout.placed.resize(count);
  std::vector<double> wish(count, 0.0);
  std::vector<std::vector<std::uint32_t>> layers(kMostColumns);
  for (std::uint32_t i = 0; i < count; ++i) layers[column[i]].push_back(i);
  const auto number = [&] {
    for (const auto& layer : layers)
      for (std::uint32_t row = 0; row < layer.size(); ++row)
        layout.placed[layer[row]] = {layer[row], column[layer[row]], row};
  };
  number();
  for (int round = 0; round < 4; ++round) {
    for (auto& layer : layers) {
      for (const std::uint32_t i : layer) {
        double sum = 0.0;
        int neighbours = 0;
        for (const ModelLink& link : model.links) {
          if (link.from != i && link.to != i) continue;
          sum += layout.placed[link.from == i ? link.to : link.from].row;
          ++neighbours;
        }
        wish[i] = neighbours > 0 ? sum / neighbours : layout.placed[i].row;
      }
      std::stable_sort(layer.begin(), layer.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return wish[a] < wish[b]; });
    }
    number();
  }
  for (const Placed& placed : layout.placed) {
    layout.columns = std::max(layout.columns, placed.column + 1);
    layout.rows = std::max(layout.rows, placed.row + 1);
  }
  return layout;
}

}  // namespace stepwright::components

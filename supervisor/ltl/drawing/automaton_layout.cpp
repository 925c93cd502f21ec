#include "supervisor/ltl/drawing/automaton_layout.h"

#include <algorithm>
#include <utility>

namespace stepwright::ltl {

namespace {

class AutomatonLayout {
 public:
  explicit AutomatonLayout(const AutomatonGraph& graph)
      : graph_(graph), places_(graph.after.size()), mark_(graph.after.size(), Mark::Fresh) {}

  std::vector<StatePlace> make() {
    search();
    columns();
    rows();
    return std::move(places_);
  }

 private:
  enum class Mark : std::uint8_t { Fresh, OnTheWay, Left };
  struct Visit {
    std::uint32_t state;
    std::size_t next = 0;  // of those behind it
  };

  // Depth first: in `left_` a state stands behind all that it leads to, but for what leads back.
  void search() {
    std::vector<Visit> way = {{graph_.initial}};
    mark_[graph_.initial] = Mark::OnTheWay;
    while (!way.empty()) {
      Visit& here = way.back();
      const auto& after = graph_.after[here.state];
      if (here.next == after.size()) {
        mark_[here.state] = Mark::Left;
        left_.push_back(here.state);
        way.pop_back();
        continue;
      }
      const std::uint32_t next = after[here.next++];
      if (mark_[next] == Mark::OnTheWay) {
        back_.push_back({here.state, next});
      } else if (mark_[next] == Mark::Fresh) {
        mark_[next] = Mark::OnTheWay;
        way.push_back({next});
      }
    }
    std::ranges::sort(back_);
  }

  void columns() {
    for (auto from = left_.rbegin(); from != left_.rend(); ++from) {
      places_[*from].reached = true;
      for (const std::uint32_t to : graph_.after[*from]) {
        if (std::ranges::binary_search(back_, std::pair(*from, to))) continue;
        places_[to].column = std::max(places_[to].column, places_[*from].column + 1);
      }
    }
    std::uint32_t last = 0;
    for (const std::uint32_t state : left_)
      if (!is_behind(state)) last = std::max(last, places_[state].column);
    for (const std::uint32_t state : left_)
      if (is_behind(state)) places_[state].column = last + 1;
  }

  bool is_behind(std::uint32_t state) const { return graph_.decided[state] != 0 && state != graph_.initial; }
  bool is_first(std::uint32_t state) const {
    return std::ranges::find(graph_.first_row, state) != graph_.first_row.end();
  }

  // Column by column, near to the rows of what leads there.
  void rows() {
    std::vector<double> sum(places_.size(), 0.0), count(places_.size(), 0.0);
    std::vector<std::uint32_t> order(left_.rbegin(), left_.rend());
    std::ranges::stable_sort(order, {}, [&](std::uint32_t state) { return places_[state].column; });
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      while (end < order.size() && places_[order[end]].column == places_[order[begin]].column) ++end;
      const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = order.begin() + static_cast<std::ptrdiff_t>(end);
      std::stable_sort(first, last, [&](std::uint32_t a, std::uint32_t b) {
        const auto key = [&](std::uint32_t state) {
          return std::pair(graph_.decided[state], sum[state] / std::max(1.0, count[state]));
        };
        return key(a) < key(b);
      });
      std::uint32_t row = graph_.first_row.empty() ? 0 : 1;
      for (auto state = first; state != last; ++state) {
        places_[*state].row = is_first(*state) ? 0 : row++;
        for (const std::uint32_t to : graph_.after[*state]) {
          sum[to] += places_[*state].row;
          count[to] += 1.0;
        }
      }
    }
  }

  const AutomatonGraph& graph_;
  std::vector<StatePlace> places_;
  std::vector<Mark> mark_;
  std::vector<std::uint32_t> left_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> back_;  // arrows
};

}  // namespace

std::vector<StatePlace> lay_out(const AutomatonGraph& graph) {
  return AutomatonLayout(graph).make();
}

}  // namespace stepwright::ltl

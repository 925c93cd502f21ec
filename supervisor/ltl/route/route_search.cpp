#include "supervisor/ltl/route/route_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kTrust = 0.85;          // share of the guide's ways, which are not taut
constexpr std::size_t kLookEvery = 256;  // nodes, at the clock

double turn_rad(Point in, Point out) {
  if ((in.x_m == 0.0 && in.y_m == 0.0) || (out.x_m == 0.0 && out.y_m == 0.0)) return 0.0;
  return std::abs(std::atan2(cross(in, out), dot(in, out)));
}

double chance(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  std::uint64_t x = seed * 0x9E3779B97F4A7C15u + std::min(a, b) * 0xC2B2AE3D27D4EB4Fu + std::max(a, b);
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1.0p-53;
}

}  // namespace

RouteSearch::RouteSearch(const RouteGraph& graph, TaskStates states, const RouteGuide& guide)
    : graph_(graph), states_(std::move(states)), guide_(guide), is_sparse_(states_.automaton() == nullptr) {
  if (guide_.guide == nullptr) return;
  for (const Point at : graph_.points()) regions_.push_back(guide_.map->locate(at));
}

std::uint32_t RouteSearch::after(std::uint32_t row, const RouteGraph::Way& way,
                                 const RouteGraph::Words& words) {
  if (way.word == 0) return row_[row].state;
  std::vector<std::uint32_t>& known = row_[row].known->after;
  const bool is_known = way.word < known.size();
  if (is_known && known[way.word] != kUnknown) return known[way.word];
  std::uint32_t state = row_[row].state;
  for (const Label letter : words.word(way.word)) {
    state = states_.next(state, letter);
    if (states_.accepting(state)) break;
    if (states_.rejecting(state)) {
      state = kBroken;
      break;
    }
  }
  if (is_known) known[way.word] = state;
  return state;
}

bool RouteSearch::close(std::uint32_t row, Label near) {
  if (near == 0) return false;
  const auto [known, is_new] = row_[row].known->broken_by.try_emplace(near, false);
  if (is_new) known->second = states_.rejecting(states_.next(row_[row].state, near));
  return known->second;
}

std::uint32_t RouteSearch::row(std::uint32_t state) {
  const auto [found, is_new] = rows_.try_emplace(state, static_cast<std::uint32_t>(rows_.size()));
  if (is_new) {
    const auto [known, is_unknown] = known_.try_emplace(state);
    if (is_unknown) {
      known->second.left_m = guide_.place_m > 0.0 ? guide_.place_m * states_.left(state) : 0.0;
      known->second.after.assign(is_sparse_ ? 0 : graph_.words(), kUnknown);
    }
    row_.push_back({state, &known->second});
  }
  const std::size_t needed = row_.size() * graph_.points().size();
  if (!is_sparse_ && dense_.size() < needed) dense_.resize(needed);
  return found->second;
}

double RouteSearch::to_go_m(std::uint32_t point, std::uint32_t row) const {
  if (guide_.guide == nullptr || regions_[point] == kNoRegion) return row_[row].known->left_m;
  return kTrust * guide_.guide->to_go_m(regions_[point], row_[row].state);
}

// A row of n trailers follows the car's way as if that were smoothed over about hitch * sqrt(n): at a turn
// its last one is that much times sqrt(2 / pi) times the sine of half of the angle inwards of it.
double RouteSearch::cut_m(const Step& step, Point out, const RouteQuery& query) const {
  const double in_m = std::hypot(step.came.x_m, step.came.y_m), out_m = std::hypot(out.x_m, out.y_m);
  if (query.trail_m <= 0.0 || in_m == 0.0 || out_m == 0.0) return 0.0;
  const Point inwards = (0.5 / out_m) * out - (0.5 / in_m) * step.came;
  double least_m = query.half_m;
  for (const double share : {0.5, 1.0})
    least_m = std::min(least_m, graph_.clearance_m(step.at + share * query.trail_m * inwards));
  return query.cut_m * (1.0 - least_m / query.half_m);
}

// What a way costs from there, and whether that is better than what was known of its end.
void RouteSearch::relax(const Step& step, const RouteQuery& query, const RouteGraph::Words& words) {
  const RouteGraph::Way& way = *step.way;
  const std::uint32_t state = after(step.row, way, words);
  if (state == kBroken) return;
  const auto count = static_cast<std::uint32_t>(graph_.points().size());
  double more = way.cost_m + (close(step.row, way.near) ? query.close_m : 0.0);
  if (query.noise > 0.0) {
    const std::uint32_t from = step.before == kStart ? count : step.before % count;
    more *= 1.0 + query.noise * (2.0 * chance(query.seed, from, way.to) - 1.0);
  }
  const Point out = graph_.points()[way.to] - step.at;
  more += query.turn_m * turn_rad(step.came, out) + cut_m(step, out, query);
  const std::uint32_t to_row = row(state);
  const std::uint32_t index = to_row * count + way.to;
  Node& next = node(index);
  if (next.done || step.cost_m + more >= next.cost_m) return;
  const double left = to_go_m(way.to, to_row);
  if (left == Guide::kNever) return;
  next.cost_m = step.cost_m + more;
  next.before = step.before;
  next.way = &way;
  open_.emplace(next.cost_m + left, index);
}

Route RouteSearch::route(const RouteQuery& query) {
  const auto count = static_cast<std::uint32_t>(graph_.points().size());
  dense_.clear();
  sparse_.clear();
  open_ = {};
  rows_.clear();
  row_.clear();
  // Too many states of earlier questions are forgotten.
  if (known_.size() * count > query.most_nodes / 2 || is_sparse_) known_.clear();
  if (states_.accepting(query.state)) return {{query.at, query.state, {}}};
  if (states_.rejecting(query.state)) return {};
  RouteGraph::Words own;
  own.before = &graph_.all_words();
  std::vector<RouteGraph::Way> first;
  for (std::uint32_t k = 0; k < count; ++k) {
    auto way = graph_.way(query.at, graph_.points()[k], own);
    if (!way) continue;
    way->to = k;
    first.push_back(*way);
  }
  const std::uint32_t start_row = row(query.state);
  const Point heading{std::cos(query.heading_rad), std::sin(query.heading_rad)};
  for (const auto& way : first) relax({kStart, start_row, query.at, heading, 0.0, &way}, query, own);
  while (!open_.empty() && size() < query.most_nodes && !states_.exhausted()) {
    const std::uint32_t index = open_.top().second;
    open_.pop();
    if (node(index).done) continue;
    node(index).done = true;
    if (++expanded_ % kLookEvery == 0 && query.stop.over()) return {};
    const std::uint32_t at_row = index / count, at = index % count;
    if (states_.accepting(row_[at_row].state)) return path(index, query, own);
    const std::uint32_t before = node(index).before;
    const double cost = node(index).cost_m;
    const Point here = graph_.points()[at];
    const Point came = here - (before == kStart ? query.at : graph_.points()[before % count]);
    for (const auto& way : graph_.ways(at)) relax({index, at_row, here, came, cost, &way}, query, own);
  }
  return {};
}

Route RouteSearch::path(std::uint32_t last, const RouteQuery& query, const RouteGraph::Words& own) {
  const auto count = static_cast<std::uint32_t>(graph_.points().size());
  std::vector<std::uint32_t> order;
  for (std::uint32_t at = last; at != kStart; at = node(at).before) order.push_back(at);
  Route route = {{query.at, query.state, {}}};
  std::uint32_t state = query.state;
  for (auto at = order.rbegin(); at != order.rend(); ++at) {
    RoutePoint point{graph_.points()[*at % count], state, {}};
    for (const Label letter : own.word(node(*at).way->word)) {
      if (states_.accepting(state)) break;
      const std::uint32_t next = states_.next(state, letter);
      if (next != state) point.through.push_back(next);
      state = next;
    }
    point.state = state;
    route.push_back(std::move(point));
  }
  return route;
}

}  // namespace stepwright::ltl

#include <algorithm>
#include <cmath>
#include <numbers>

#include "supervisor/ltl/route/route_search.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kEntered_m = 0.12;  // how deep in a place a point lies that is there to enter it
constexpr double kLeastGain_m = 1e-4;
constexpr int kDirections = 8;

}  // namespace

std::optional<RoutePoint> RouteSearch::reached(const RoutePoint& from, Point to) {
  RouteGraph::Words own;
  own.before = &graph_.all_words();
  const auto way = graph_.way(from.at, to, own);
  if (!way) return std::nullopt;
  RoutePoint next{to, from.state, {}};
  for (const Label letter : own.word(way->word)) {
    if (states_.accepting(next.state)) break;
    const std::uint32_t state = states_.next(next.state, letter);
    if (states_.rejecting(state)) return std::nullopt;
    if (state != next.state) next.through.push_back(state);
    next.state = state;
  }
  return next;
}

// What a point's move makes the route shorter by, where it makes it so and changes no state; then it is done.
std::optional<double> RouteSearch::moved(Route& route, std::size_t k, Point to, double margin_m) {
  const bool is_last = k + 1 == route.size();
  const auto around_m = [&](Point at) {
    return geometry::distance(route[k - 1].at, at) +
           (is_last ? 0.0 : geometry::distance(at, route[k + 1].at));
  };
  const double gain_m = around_m(route[k].at) - around_m(to);
  if (gain_m < kLeastGain_m || graph_.clearance_m(to) < margin_m) return std::nullopt;
  if (!route[k].through.empty()) {
    const Label label = graph_.places().label(to);
    for (const Point aside :
         {Point{kEntered_m, 0.0}, {-kEntered_m, 0.0}, {0.0, kEntered_m}, {0.0, -kEntered_m}})
      if (graph_.places().label(to + aside) != label) return std::nullopt;
  }
  const auto here = reached(route[k - 1], to);
  if (!here || here->state != route[k].state) return std::nullopt;
  if (!is_last) {
    const auto next = reached(*here, route[k + 1].at);
    if (!next || next->state != route[k + 1].state) return std::nullopt;
    route[k + 1] = *next;
  }
  route[k] = *here;
  return gain_m;
}

// Whether the route does without that point; then it is gone.
bool RouteSearch::dropped(Route& route, std::size_t k) {
  if (k + 1 >= route.size() || !route[k].through.empty()) return false;
  const auto next = reached(route[k - 1], route[k + 1].at);
  if (!next || next->state != route[k + 1].state || next->through != route[k + 1].through) return false;
  route[k + 1] = *next;
  route.erase(route.begin() + static_cast<std::ptrdiff_t>(k));
  return true;
}

Route RouteSearch::tightened(Route route, double margin_m, const Stop& stop) {
  for (double step_m = 0.8; step_m > 0.04; step_m *= 0.5) {
    for (int round = 0; round < 6; ++round) {
      double gained_m = 0.0;
      for (std::size_t k = 1; k < route.size(); ++k) {
        if (stop.over()) return route;
        if (dropped(route, k)) continue;
        const Point at = route[k].at;
        for (int n = 0; n < kDirections; ++n) {
          const double angle = 2.0 * std::numbers::pi * n / kDirections;
          const auto gain_m =
              moved(route, k, at + Point{step_m * std::cos(angle), step_m * std::sin(angle)}, margin_m);
          if (!gain_m) continue;
          gained_m += *gain_m;
          break;
        }
      }
      if (gained_m < 0.01) break;
    }
  }
  return route;
}

}  // namespace stepwright::ltl

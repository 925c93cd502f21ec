#include "supervisor/ltl/search/train_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kSwell_m = 0.04;  // of links, against what a step of 0.1 m does not see
constexpr std::size_t kLevels = 3;

TrainModel swollen(TrainModel model) {
  model.length_m += kSwell_m;
  model.width_m += kSwell_m;
  return model;
}

// How far the last trailer may cut a corner, roughly; growing with what is pulled.
double wanted_m(const TrainModel& model) {
  return 0.5 * model.width_m + 0.3 + 0.13 * static_cast<double>(model.trailers) * std::min(1.0, model.hitch_m);
}

double tightest_m(const TrainModel& model) {
  const double least = 1.02 * model.wheelbase_m / std::tan(0.98 * model.most_lock_rad);
  const double pulled = model.hitch_m * (0.8 + 0.1 * static_cast<double>(model.trailers));
  return model.trailers == 0 ? least : std::max(least, pulled);
}

}  // namespace

// Routes with a clearance: the first level keeps the most.
struct TrainSearch::Routes {
  RouteGraph graph;
  RouteSearch search;

  Routes(const Floor& floor, const Places& places, const Walls& walls, const RouteOptions& options,
         const TaskStates& states, const RouteGuide& guide)
      : graph(floor, places, walls, options), search(graph, states, guide) {}
};

TrainSearch::TrainSearch(const Floor& floor, const RegionMap& map, const Places& places,
                         const TrainModel& model, TaskStates states)
    : floor_(floor),
      map_(map),
      places_(places),
      model_(model),
      states_(states),
      wide_(swollen(model)),
      walls_(floor, wide_),
      driver_(model_, walls_, places, states),
      routes_(kLevels) {}

TrainSearch::~TrainSearch() = default;

TrainSearch::Routes& TrainSearch::routes(std::size_t level) {
  if (routes_[level] == nullptr) {
    const double half = 0.5 * model_.width_m;
    RouteOptions options{.margin_m = half + 0.1, .wanted_m = wanted_m(model_)};
    if (level == 1) options.wanted_m *= 1.5;
    if (level == 2) options.wanted_m = half + 0.3;
    if (!guide_ && states_.automaton() != nullptr) guide_.emplace(map_, *states_.automaton());
    const RouteGuide guide = guide_ ? RouteGuide{&map_, &*guide_} : RouteGuide{};
    routes_[level] = std::make_unique<Routes>(floor_, places_, walls_, options, states_, guide);
  }
  return *routes_[level];
}

DriveStyle TrainSearch::style(bool by_chance) {
  const double tightest = tightest_m(model_);
  DriveStyle style{.lookahead_m = model_.trailers == 0 ? 0.8 : 1.0, .tightest_m = tightest, .cruise_m_s = 1.6};
  if (!by_chance) return style;
  const double least = 1.02 * model_.wheelbase_m / std::tan(0.98 * model_.most_lock_rad);
  style.lookahead_m *= 0.7 + 1.6 * chance();
  style.tightest_m = std::max(least, tightest * (0.6 + 1.2 * chance()));
  style.cruise_m_s = 0.8 + 1.2 * chance();
  style.side = static_cast<int>(3.0 * chance()) - 1;
  return style;
}

bool TrainSearch::begin(const SearchQuery& query) {
  dice_.seed(query.seed);
  nodes_.clear();
  Node root;
  root.state = query.start;
  root.task = states_.next(states_.start(), places_.label({query.start[kTrainX], query.start[kTrainY]}));
  root.left_m = std::numeric_limits<double>::infinity();
  nodes_.push_back(root);
  return driver_.valid(query.start) && !states_.rejecting(root.task);
}

// The least that is left to drive, where what failed nearby counts as a detour.
std::size_t TrainSearch::choose() {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const double left = std::min(nodes_[k].left_m, 1e6) + nodes_[k].fails * 6.0 * (0.3 + 1.4 * chance());
    if (left < least) best = k;
    least = std::min(least, left);
  }
  return best;
}

void TrainSearch::add(std::size_t parent, const Drive& drive) {
  std::size_t used = 0;
  double driven = 0.0;
  for (const DriveMark& mark : drive.marks) {
    if (mark.pieces == used) continue;
    Node node;
    node.state = mark.state;
    node.task = mark.task;
    node.parent = static_cast<std::uint32_t>(parent);
    node.pieces.assign(drive.pieces.begin() + static_cast<std::ptrdiff_t>(used),
                       drive.pieces.begin() + static_cast<std::ptrdiff_t>(mark.pieces));
    node.length_m = nodes_[parent].length_m + mark.length_m - driven;
    node.left_m = mark.left_m;
    used = mark.pieces;
    driven = mark.length_m;
    nodes_.push_back(std::move(node));
    parent = nodes_.size() - 1;
  }
}

// What lies shortly before a failure leads there again.
void TrainSearch::blame(std::size_t parent, std::size_t first_new, const Drive& drive) {
  const std::size_t last = nodes_.size() > first_new ? nodes_.size() - 1 : parent;
  const double end_m = nodes_[last].length_m;
  const double reach_m = 1.5 + 0.4 * static_cast<double>(model_.trailers);
  if (drive.end == DriveEnd::Astray || drive.end == DriveEnd::Over) {
    nodes_[last].fails += 0.2;
    return;
  }
  for (std::size_t at = last;; at = nodes_[at].parent) {
    const double before_m = end_m - nodes_[at].length_m;
    nodes_[at].fails += 1.0 * std::exp(-before_m / reach_m);
    if (at == 0 || before_m > 6.0 * reach_m) break;
  }
}

TrainPlan TrainSearch::plan_to(std::size_t node) const {
  TrainPlan plan;
  plan.start = nodes_[0].state;
  plan.end = nodes_[node].state;
  plan.length_m = nodes_[node].length_m;
  std::vector<std::size_t> order;
  for (std::size_t at = node; at != 0; at = nodes_[at].parent) order.push_back(at);
  for (auto at = order.rbegin(); at != order.rend(); ++at)
    plan.pieces.insert(plan.pieces.end(), nodes_[*at].pieces.begin(), nodes_[*at].pieces.end());
  return plan;
}

// Any control from there; whether that ended the task.
bool TrainSearch::explore(std::size_t from, SearchAnswer& answer) {
  const bool reverse = model_.trailers <= 1 ? chance() < 0.5 : chance() < 0.1;
  const double push = model_.most_acceleration_m_s2 * chance();
  const TrainControl control{reverse ? -push : push,
                             model_.most_lock_rate_rad_s * (2.0 * chance() - 1.0)};
  Drive drive = driver_.hold(nodes_[from].state, nodes_[from].task, control, 0.2 + 2.0 * chance());
  for (DriveMark& mark : drive.marks) mark.left_m = nodes_[from].left_m;
  add(from, drive);
  if (drive.end != DriveEnd::Done) return false;
  answer.plan = plan_to(nodes_.size() - 1);
  return true;
}

SearchAnswer TrainSearch::first(const SearchQuery& query) {
  const auto began = Clock::now();
  const auto spent_s = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
  SearchAnswer answer;
  const std::uint64_t steps = driver_.steps();
  const bool possible = begin(query);
  routes(0);
  answer.prepared_s = spent_s();
  for (std::size_t round = 0; possible && !answer.plan && spent_s() < query.most_s; ++round) {
    const std::size_t from = choose();
    if (round > 0 && chance() < 0.1) {
      explore(static_cast<std::size_t>(chance() * static_cast<double>(nodes_.size() - 1)), answer);
      continue;
    }
    const bool by_chance = round > 0 && chance() < 0.8;
    Routes& ways = routes(by_chance ? static_cast<std::size_t>(chance() * 2.99) : 0);
    const TrainState& state = nodes_[from].state;
    const Route route = ways.search.route({.at = {state[kTrainX], state[kTrainY]},
                                             .heading_rad = state[kTrainHeading],
                                             .state = nodes_[from].task,
                                             .turn_m = tightest_m(model_),
                                             .noise = by_chance ? 0.6 * chance() : 0.0,
                                             .seed = dice_()});
    if (route.empty()) {
      nodes_[from].fails += 1.0;
      continue;
    }
    ++answer.drives;
    const Drive drive = driver_.along(route, state, style(by_chance));
    const std::size_t first_new = nodes_.size();
    add(from, drive);
    if (drive.end == DriveEnd::Done)
      answer.plan = plan_to(nodes_.size() - 1);
    else
      blame(from, first_new, drive);
  }
  answer.nodes = nodes_.size();
  answer.steps = driver_.steps() - steps;
  answer.spent_s = spent_s();
  return answer;
}

SearchAnswer TrainSearch::shorter(const SearchQuery& query, double than_m) {
  const auto began = Clock::now();
  const auto spent_s = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
  SearchAnswer best;
  const std::uint64_t steps = driver_.steps();
  if (!begin(query)) return best;
  double least = than_m;
  while (spent_s() < query.most_s) {
    Routes& ways = routes(chance() < 0.5 ? 0 : 2);
    const Route route = ways.search.route({.at = {query.start[kTrainX], query.start[kTrainY]},
                                             .heading_rad = query.start[kTrainHeading],
                                             .state = nodes_[0].task,
                                             .turn_m = tightest_m(model_) * chance(),
                                             .noise = 0.15 * chance(),
                                             .seed = dice_()});
    if (route.empty()) break;
    for (std::size_t n = 0; n < 4 && spent_s() < query.most_s; ++n) {
      ++best.drives;
      const Drive drive = driver_.along(route, query.start, style(true));
      if (drive.end != DriveEnd::Done || drive.marks.back().length_m >= least) continue;
      least = drive.marks.back().length_m;
      best.plan = TrainPlan{query.start, drive.pieces, drive.marks.back().state, least};
    }
  }
  best.steps = driver_.steps() - steps;
  best.spent_s = spent_s();
  return best;
}

}  // namespace stepwright::ltl

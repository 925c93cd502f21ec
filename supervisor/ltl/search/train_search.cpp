#include "supervisor/ltl/search/train_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kSwell_m = 0.05;  // of links, against what two looks do not see between them
constexpr std::size_t kLevels = 3;
constexpr double kShort_m = 0.5;     // a drive that ends sooner says that its state is as good as lost
constexpr double kShortFails = 1.0;  // and counts so much more
constexpr double kSmoothing = 0.9;   // of a row of trailers, which cuts turns: more than sqrt(2 / pi), for
                                     // turns that are several ones shortly after each other
constexpr double kReach_m = 2.0;     // of a failure, on the way before it
constexpr std::size_t kMostStages = 2'000'000;  // of the guide: regions times states
constexpr std::size_t kMostNodes = 100'000;     // beyond them the tree begins anew

TrainModel swollen(TrainModel model) {
  model.length_m += kSwell_m;
  model.width_m += kSwell_m;
  if (model.most_hitch_rad < std::numbers::pi) model.most_hitch_rad -= 1.2 * kSwell_m / model.hitch_m;
  return model;
}

// How far the last trailer may cut a corner, roughly; growing with what is pulled.
double wanted_m(const TrainModel& model) {
  return 0.5 * model.width_m + 0.3 +
         0.13 * static_cast<double>(model.trailers) * std::min(1.0, model.hitch_m);
}

double tightest_m(const TrainModel& model) {
  const double least = 1.02 * model.wheelbase_m / std::tan(0.98 * model.most_lock_rad);
  const double pulled = model.hitch_m * (0.8 + 0.1 * static_cast<double>(model.trailers));
  return model.trailers == 0 ? least : std::max(least, pulled);
}

double length_m(const Route& route) {
  double length = 0.0;
  for (std::size_t k = 1; k < route.size(); ++k) length += geometry::distance(route[k - 1].at, route[k].at);
  return length;
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
                         const TrainModel& model, TaskStates states, SearchGuide use)
    : floor_(floor),
      map_(map),
      places_(places),
      model_(model),
      states_(states),
      use_(use),
      wide_(swollen(model)),
      walls_(floor, wide_),
      driver_(model_, wide_, walls_, places, states),
      routes_(kLevels) {}

TrainSearch::~TrainSearch() = default;

TrainSearch::Routes& TrainSearch::routes(std::size_t level) {
  if (routes_[level] == nullptr) {
    const double half = 0.5 * model_.width_m;
    RouteOptions options{.margin_m = half + 0.1, .wanted_m = wanted_m(model_), .until = until_};
    if (level == 1) options.wanted_m *= 1.5;
    if (level == 2) options.wanted_m = half + 0.3;
    RouteGuide guide;
    if (use_ == SearchGuide::OnTheRegions) {
      const Automaton* const automaton = states_.automaton();
      if (!guide_ && automaton != nullptr && map_.regions().size() * automaton->size() <= kMostStages)
        guide_.emplace(map_, *automaton);
      const geometry::Box box = geometry::bounds_of(map_.points());
      guide = guide_ ? RouteGuide{&map_, &*guide_} : RouteGuide{.place_m = distance(box.low, box.high)};
    }
    routes_[level] = std::make_unique<Routes>(floor_, places_, walls_, options, states_, guide);
  }
  return *routes_[level];
}

DriveStyle TrainSearch::style(bool by_chance) {
  const double tightest = tightest_m(model_);
  DriveStyle style{
      .lookahead_m = model_.trailers == 0 ? 0.8 : 1.0, .tightest_m = tightest, .cruise_m_s = 1.6};
  if (!by_chance) return style;
  const double least = 1.02 * model_.wheelbase_m / std::tan(0.98 * model_.most_lock_rad);
  style.lookahead_m *= 0.7 + 1.6 * chance();
  style.tightest_m = std::max(least, tightest * (0.6 + 1.2 * chance()));
  style.cruise_m_s = 0.8 + 1.2 * chance();
  style.side = static_cast<int>(3.0 * chance()) - 1;
  return style;
}

// Within the floor as a whole: walls know sides only.
bool TrainSearch::stands(const TrainState& state) const {
  if (!std::ranges::all_of(state, [](double value) { return std::isfinite(value); })) return false;
  if (std::abs(state[kTrainSpeed]) > model_.most_speed_m_s ||
      std::abs(state[kTrainLock]) > model_.most_lock_rad)
    return false;
  const LinkBoxes boxes = link_boxes(model_, state);
  for (std::size_t link = 0; link < model_.links(); ++link)
    if (map_.locate(boxes[link].middle) == kNoRegion) return false;
  return driver_.valid(state);
}

// How it ends before it begins, if it does.
std::optional<SearchEnd> TrainSearch::begin(const SearchQuery& query) {
  constexpr double kLongest_s = 1e6;  // more would overflow some clocks
  const std::chrono::duration<double> most(query.most_s > 0.0 ? std::min(query.most_s, kLongest_s) : 0.0);
  until_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(most);
  dice_.seed(query.seed);
  nodes_.clear();
  if (!stands(query.start)) return SearchEnd::BadStart;
  const Point here{query.start[kTrainX], query.start[kTrainY]};
  const std::uint32_t task = states_.next(states_.start(), places_.label(here));
  Node root;
  root.at = driver_.stand(query.start, task);
  root.left_m = std::numeric_limits<double>::infinity();
  nodes_.push_back(std::move(root));
  if (states_.rejecting(task)) return SearchEnd::BadStart;
  if (states_.accepting(task)) return SearchEnd::Found;
  routes(0);
  if (guide_ && guide_->to_go_m(map_.locate(here), task) == Guide::kNever) return SearchEnd::NoWay;
  return std::nullopt;
}

std::optional<SearchEnd> TrainSearch::over(const SearchQuery& query, std::size_t rounds) const {
  if (query.cancel != nullptr && query.cancel->load()) return SearchEnd::Cancelled;
  if (Clock::now() >= until_ || rounds >= query.most_rounds || states_.exhausted()) return SearchEnd::Bound;
  return std::nullopt;
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

// The marks of a drive as a branch; the last node of it.
std::size_t TrainSearch::add(std::size_t parent, const Drive& drive) {
  std::size_t used = 0;
  double driven = 0.0;
  for (const DriveMark& mark : drive.marks) {
    if (mark.pieces == used) continue;
    Node node;
    node.at = mark;
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
  return parent;
}

// What lies shortly before a failure leads there again; where a trailer met a wall, all that was driven since
// the car passed there.
void TrainSearch::blame(std::size_t parent, std::size_t first_new, const Drive& drive) {
  const std::size_t last = nodes_.size() > first_new ? nodes_.size() - 1 : parent;
  const double end_m = nodes_[last].length_m;
  const double lag_m = static_cast<double>(drive.blocked_link) * model_.spacing_m;
  const double reach_m = kReach_m;
  if (drive.end == DriveEnd::Astray || drive.end == DriveEnd::Over) {
    nodes_[last].fails += 0.2;
    return;
  }
  for (std::size_t at = last;; at = nodes_[at].parent) {
    const double before_m = end_m - nodes_[at].length_m;
    nodes_[at].fails += std::exp(-std::max(0.0, before_m - lag_m) / reach_m);
    if (at == 0 || before_m > lag_m + 6.0 * reach_m) break;
  }
}

TrainPlan TrainSearch::plan_to(std::size_t node) const {
  TrainPlan plan;
  plan.start = nodes_[0].at.state;
  plan.end = nodes_[node].at.state;
  plan.length_m = nodes_[node].length_m;
  std::vector<std::size_t> order;
  for (std::size_t at = node; at != 0; at = nodes_[at].parent) order.push_back(at);
  for (auto at = order.rbegin(); at != order.rend(); ++at)
    plan.pieces.insert(plan.pieces.end(), nodes_[*at].pieces.begin(), nodes_[*at].pieces.end());
  return plan;
}

Route TrainSearch::route_from(const Node& node, Routes& ways, double turn_m, double noise) {
  const TrainState& state = node.at.state;
  // By chance more or less room for it: where the estimate is wrong, another route is tried.
  const double share = noise > 0.0 ? 0.6 + 0.8 * chance() : 1.0;
  const double trail = share * kSmoothing * model_.hitch_m * std::sqrt(static_cast<double>(model_.trailers));
  return ways.search.route({.at = {state[kTrainX], state[kTrainY]},
                            .heading_rad = state[kTrainHeading],
                            .state = node.at.task,
                            .turn_m = turn_m,
                            .trail_m = trail,
                            .half_m = 0.5 * model_.width_m + kSwell_m,
                            .noise = noise,
                            .seed = dice_(),
                            .until = until_});
}

// Any control from there, often a straight one back; whether that ended the task: then the last node did.
bool TrainSearch::explore(std::size_t from) {
  const bool reverse = chance() < (model_.trailers <= 1 ? 0.5 : 0.3);
  const bool straight = chance() < 0.5;
  const double push = model_.most_acceleration_m_s2 * chance();
  const double turn = straight ? 0.0 : 2.0 * chance() - 1.0;
  const TrainControl control{reverse ? -push : push, model_.most_lock_rate_rad_s * turn};
  Drive drive = driver_.hold(nodes_[from].at, control, 0.2 + 2.5 * chance());
  for (DriveMark& mark : drive.marks) mark.left_m = nodes_[from].left_m + mark.length_m;
  add(from, drive);
  return drive.end == DriveEnd::Done;
}

// Along a route from there; whether that ended the task: then the last node did.
bool TrainSearch::drive_from(std::size_t from, bool by_chance, SearchAnswer& answer) {
  Routes& ways = routes(by_chance ? static_cast<std::size_t>(chance() * 2.99) : 0);
  const Route route = route_from(nodes_[from], ways, tightest_m(model_), by_chance ? 0.6 * chance() : 0.0);
  if (route.empty()) {
    nodes_[from].fails += 1.0;
    return false;
  }
  // Of the root, which has no way to it.
  if (std::isinf(nodes_[from].left_m)) nodes_[from].left_m = length_m(route);
  ++answer.drives;
  const Drive drive = driver_.along(route, nodes_[from].at, style(by_chance));
  const std::size_t first_new = nodes_.size();
  // Hardly moved: what it would add fails as it does.
  const bool is_short = drive.end != DriveEnd::Done && drive.marks.back().length_m < kShort_m;
  if (is_short)
    nodes_[from].fails += kShortFails;
  else
    add(from, drive);
  if (drive.end == DriveEnd::Done) return true;
  blame(from, first_new, drive);
  return false;
}

SearchAnswer TrainSearch::first(const SearchQuery& query) {
  const auto began = Clock::now();
  const auto spent_s = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
  SearchAnswer answer;
  const std::uint64_t steps = driver_.steps();
  std::optional<SearchEnd> end = begin(query);
  answer.prepared_s = spent_s();
  std::size_t most_nodes = nodes_.size();
  for (std::size_t round = 0; !end; ++round) {
    if ((end = over(query, round))) break;
    if (nodes_.size() > kMostNodes) {
      nodes_.resize(1);
      nodes_[0].fails = 0.0;
    }
    // Early nodes more often: there the train stands, or is slow.
    const auto any = static_cast<std::size_t>(std::pow(chance(), 3.0) * static_cast<double>(nodes_.size()));
    const bool done = round > 0 && chance() < 0.1
                          ? explore(std::min(any, nodes_.size() - 1))
                          : drive_from(choose(), (round > 0 || query.by_chance) && chance() < 0.8, answer);
    most_nodes = std::max(most_nodes, nodes_.size());
    if (done) end = SearchEnd::Found;
  }
  answer.end = *end;
  if (answer.end == SearchEnd::Found) answer.plan = plan_to(nodes_.size() - 1);
  answer.nodes = most_nodes;
  answer.steps = driver_.steps() - steps;
  answer.spent_s = spent_s();
  return answer;
}

SearchAnswer TrainSearch::shorter(const SearchQuery& query, double than_m) {
  const auto began = Clock::now();
  SearchAnswer best;
  const std::uint64_t steps = driver_.steps();
  std::optional<SearchEnd> end = begin(query);
  double least = than_m;
  for (std::size_t round = 0; !end; ++round) {
    if ((end = over(query, round))) break;
    Routes& ways = routes(chance() < 0.5 ? 0 : 2);
    const double turn_m = tightest_m(model_) * chance();
    Route route = route_from(nodes_[0], ways, turn_m, round == 0 ? 0.0 : 0.15 * chance());
    if (!route.empty() && chance() < (model_.trailers == 0 ? 0.9 : 0.5)) {
      const RouteOptions& kept = ways.graph.options();
      const double spare = model_.trailers == 0 ? 0.0 : chance() * (kept.wanted_m - kept.margin_m);
      route = ways.search.tightened(std::move(route), kept.margin_m + spare, until_);
    }
    for (std::size_t n = 0; n < 4 && !route.empty() && !over(query, round); ++n) {
      ++best.drives;
      const Drive drive = driver_.along(route, nodes_[0].at, style(n > 0));
      if (drive.end != DriveEnd::Done || drive.marks.back().length_m >= least) continue;
      least = drive.marks.back().length_m;
      best.plan = TrainPlan{query.start, drive.pieces, drive.marks.back().state, least};
    }
  }
  best.end = best.plan ? SearchEnd::Found : *end == SearchEnd::Found ? SearchEnd::Bound : *end;
  best.nodes = nodes_.size();
  best.steps = driver_.steps() - steps;
  best.spent_s = std::chrono::duration<double>(Clock::now() - began).count();
  return best;
}

}  // namespace stepwright::ltl

#include "supervisor/ltl/search/train_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "supervisor/ltl/search/route_style.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kShort_m = 0.5;     // a drive that ends sooner says that its state is as good as lost
constexpr double kShortFails = 1.0;  // and counts so much more
constexpr double kReach_m = 2.0;     // of a failure, on the way before it
constexpr std::size_t kMostNodes = 100'000;  // beyond them the tree begins anew

double way_m(const Route& route) {
  double length = 0.0;
  for (std::size_t k = 1; k < route.size(); ++k) length += geometry::distance(route[k - 1].at, route[k].at);
  return length;
}

}  // namespace

TrainSearch::TrainSearch(const SearchGround& ground, TaskStates states)
    : ground_(ground),
      states_(std::move(states)),
      driver_(ground.model(), ground.wide(), ground.walls(), ground.places(), states_) {}

TrainSearch::~TrainSearch() = default;

// Null where there was no time for it.
RouteSearch* TrainSearch::routes(Clearance clearance) {
  auto& known = routes_[static_cast<std::size_t>(clearance)];
  if (known == nullptr) {
    const RouteGraph* const graph = ground_.graph(clearance, stop_);
    if (graph == nullptr) return nullptr;
    known = std::make_unique<RouteSearch>(*graph, states_, ground_.route_guide());
  }
  return known.get();
}

DriveStyle TrainSearch::style(bool by_chance) {
  if (!by_chance) return plain_style(ground_.model());
  return style_by_chance(ground_.model(), dice_);
}

// Walls know sides only.
bool can_stand(const SearchGround& ground, const Driver& driver, const TrainState& state) {
  const TrainModel& model = ground.model();
  if (!std::ranges::all_of(state, [](double value) { return std::isfinite(value); })) return false;
  if (std::abs(state[kTrainSpeed]) > model.most_speed_m_s ||
      std::abs(state[kTrainLock]) > model.most_lock_rad)
    return false;
  const LinkBoxes boxes = link_boxes(model, state);
  for (std::size_t link = 0; link < model.links(); ++link)
    if (ground.map().locate(boxes[link].middle) == kNoRegion) return false;
  return driver.valid(state);
}

// How it ends before it begins, if it does.
std::optional<SearchEnd> TrainSearch::begin() {
  dice_.seed(query_.seed);
  nodes_.clear();
  if (!can_stand(ground_, driver_, query_.start)) return SearchEnd::BadStart;
  const Point here{query_.start[kTrainX], query_.start[kTrainY]};
  const std::uint32_t task = states_.next(states_.start(), ground_.places().label(here));
  Node root;
  root.at = driver_.stand(query_.start, task);
  root.left_m = std::numeric_limits<double>::infinity();
  nodes_.push_back(std::move(root));
  if (states_.rejecting(task)) return SearchEnd::BadStart;
  if (states_.accepting(task)) return SearchEnd::Found;
  const Guide* const guide = ground_.guide();
  if (guide != nullptr && guide->to_go_m(ground_.map().locate(here), task) == Guide::kNever)
    return SearchEnd::NoWay;
  if (!query_.by_chance) (void)routes(Clearance::Wanted);
  return std::nullopt;
}

std::optional<SearchEnd> TrainSearch::over() const {
  if (stop_.cancelled()) return SearchEnd::Cancelled;
  if (stop_.over() || round_ >= query_.most_rounds || states_.exhausted()) return SearchEnd::Bound;
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
std::size_t TrainSearch::add(std::size_t parent, const Drive& drive, std::shared_ptr<const Route> route) {
  std::size_t used = 0;
  double driven = 0.0;
  for (const DriveMark& mark : drive.marks) {
    if (mark.pieces == used) continue;
    Node node;
    node.at = mark;
    node.parent = static_cast<std::uint32_t>(parent);
    node.pieces.assign(drive.pieces.begin() + static_cast<std::ptrdiff_t>(used),
                       drive.pieces.begin() + static_cast<std::ptrdiff_t>(mark.pieces));
    node.route = route;
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
  const double lag_m = static_cast<double>(drive.blocked_link) * ground_.model().spacing_m;
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

// From the root, which is left out.
std::vector<std::size_t> TrainSearch::way_to(std::size_t node) const {
  std::vector<std::size_t> order;
  for (std::size_t at = node; at != 0; at = nodes_[at].parent) order.push_back(at);
  std::ranges::reverse(order);
  return order;
}

TrainPlan TrainSearch::plan_to(std::size_t node) const {
  TrainPlan plan;
  plan.start = nodes_[0].at.state;
  plan.end = nodes_[node].at.state;
  plan.length_m = nodes_[node].length_m;
  for (const std::size_t at : way_to(node))
    plan.pieces.insert(plan.pieces.end(), nodes_[at].pieces.begin(), nodes_[at].pieces.end());
  return plan;
}

// Branch by branch: where a branch leaves another one, its route goes on from there. What comes before a
// control by chance follows no route.
DrivenRoute TrainSearch::driven_to(std::size_t node) const {
  DrivenRoute driven;
  driven.start = nodes_[0].at.state;
  driven.style = style_of_last_;
  Drive& drive = driven.drive;
  drive.end = DriveEnd::Done;
  const auto begin_at = [&](const Node& at) {
    DriveMark mark = at.at;
    mark.pieces = drive.pieces.size();
    mark.length_m = at.length_m;
    mark.next = 1;
    mark.seen = 0;
    driven.route = {{place_of(mark), mark.task, {}}};
    drive.marks = {mark};
  };
  begin_at(nodes_[0]);
  std::shared_ptr<const Route> along;
  std::size_t offset = 0;
  for (const std::size_t at : way_to(node)) {
    const Node& here = nodes_[at];
    drive.pieces.insert(drive.pieces.end(), here.pieces.begin(), here.pieces.end());
    if (here.route == nullptr) {
      along = nullptr;
      begin_at(here);
      continue;
    }
    if (here.route != along) {
      if (driven.route.size() == 1) {
        driven.route = *here.route;
        offset = 0;
      } else {
        driven.route = with_other_end(driven.route, drive.marks.back(), *here.route, offset);
      }
      along = here.route;
    }
    DriveMark mark = here.at;
    mark.pieces = drive.pieces.size();
    mark.length_m = here.length_m;
    mark.next += offset;
    drive.marks.push_back(mark);
  }
  return driven;
}

Route TrainSearch::route_from(const Node& node, RouteSearch& ways, double noise) {
  const TrainModel& model = ground_.model();
  // By chance more or less room for it: where the estimate is wrong, another route is tried.
  const double share = noise > 0.0 ? 0.6 + 0.8 * chance() : 1.0;
  return ways.route(route_query(model, node.at, tightest_m(model), share, noise, dice_(), stop_));
}

// Any control from there, often a straight one back; whether that ended the task: then the last node did.
bool TrainSearch::explore(std::size_t from) {
  const TrainModel& model = ground_.model();
  const bool reverse = chance() < (model.trailers <= 1 ? 0.5 : 0.3);
  const bool straight = chance() < 0.5;
  const double push = model.most_acceleration_m_s2 * chance();
  const double turn = straight ? 0.0 : 2.0 * chance() - 1.0;
  const TrainControl control{reverse ? -push : push, model.most_lock_rate_rad_s * turn};
  Drive drive = driver_.hold(nodes_[from].at, control, 0.2 + 2.5 * chance());
  for (DriveMark& mark : drive.marks) mark.left_m = nodes_[from].left_m + mark.length_m;
  add(from, drive, nullptr);
  return drive.end == DriveEnd::Done;
}

// Along a route from there; whether that ended the task: then the last node did.
bool TrainSearch::drive_from(std::size_t from, bool by_chance) {
  RouteSearch* const ways = routes(by_chance ? static_cast<Clearance>(chance() * 2.99) : Clearance::Wanted);
  if (ways == nullptr) return false;
  const auto route =
      std::make_shared<const Route>(route_from(nodes_[from], *ways, by_chance ? 0.6 * chance() : 0.0));
  if (route->empty()) {
    nodes_[from].fails += 1.0;
    return false;
  }
  // Of the root, which has no way to it.
  if (std::isinf(nodes_[from].left_m)) nodes_[from].left_m = way_m(*route);
  ++answer_.drives;
  style_of_last_ = style(by_chance);
  const Drive drive = driver_.along(*route, nodes_[from].at, style_of_last_);
  const std::size_t first_new = nodes_.size();
  // Hardly moved: what it would add fails as it does.
  const bool is_short = drive.end != DriveEnd::Done && drive.marks.back().length_m < kShort_m;
  if (is_short)
    nodes_[from].fails += kShortFails;
  else
    add(from, drive, route);
  if (drive.end == DriveEnd::Done) return true;
  blame(from, first_new, drive);
  return false;
}

// Whether it has found a plan, to the last node.
bool TrainSearch::one_round() {
  if (nodes_.size() > kMostNodes) {
    nodes_.resize(1);
    nodes_[0].fails = 0.0;
  }
  // Early nodes more often: there the train stands, or is slow.
  const auto any = static_cast<std::size_t>(std::pow(chance(), 3.0) * static_cast<double>(nodes_.size()));
  const bool done = round_ > 0 && chance() < 0.1
                        ? explore(std::min(any, nodes_.size() - 1))
                        : drive_from(choose(), (round_ > 0 || query_.by_chance) && chance() < 0.8);
  most_nodes_ = std::max(most_nodes_, nodes_.size());
  return done;
}

void TrainSearch::end_with(SearchEnd end) {
  has_end_ = true;
  answer_.end = end;
  if (end == SearchEnd::Found) {
    answer_.plan = plan_to(nodes_.size() - 1);
    answer_.driven = driven_to(nodes_.size() - 1);
  }
  answer_.nodes = most_nodes_;
  answer_.steps = driver_.steps() - steps_before_;
}

void TrainSearch::ask(const SearchQuery& query) {
  constexpr double kLongest_s = 1e6;  // more would overflow some clocks
  const auto began = Clock::now();
  const std::chrono::duration<double> most(query.most_s > 0.0 ? std::min(query.most_s, kLongest_s) : 0.0);
  query_ = query;
  answer_ = {};
  has_end_ = false;
  round_ = 0;
  steps_before_ = driver_.steps();
  stop_ = {began + std::chrono::duration_cast<Clock::duration>(most), query.cancel, query.enough};
  driver_.set_stop(stop_);
  const std::optional<SearchEnd> end = begin();
  most_nodes_ = nodes_.size();
  answer_.prepared_s = std::chrono::duration<double>(Clock::now() - began).count();
  answer_.spent_s = answer_.prepared_s;
  if (end) end_with(*end);
}

bool TrainSearch::go_on(std::size_t rounds) {
  const auto began = Clock::now();
  for (std::size_t n = 0; n < rounds && !has_end_; ++n, ++round_) {
    if (const auto end = over())
      end_with(*end);
    else if (one_round())
      end_with(SearchEnd::Found);
  }
  answer_.spent_s += std::chrono::duration<double>(Clock::now() - began).count();
  return has_end_;
}

SearchAnswer TrainSearch::first(const SearchQuery& query) {
  ask(query);
  (void)go_on(std::numeric_limits<std::size_t>::max());
  return answer_;
}

}  // namespace stepwright::ltl

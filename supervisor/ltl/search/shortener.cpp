#include "supervisor/ltl/search/shortener.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "supervisor/ltl/search/route_style.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr std::uint64_t kRoundWork = 30'000;  // steps of the integration times links
constexpr std::size_t kMostTries = 300;       // in a round, where none of them can be driven
constexpr std::size_t kMostOthers = 6;        // routes in a round
constexpr std::size_t kStyles = 4;            // of each other route
constexpr double kLeastGain_m = 1e-4;
constexpr double kSlack_m = 0.05;    // that a drive may be behind another one before it is given up
constexpr double kLongest_m = 0.15;  // that a route may get longer by
constexpr double kLeastMove_m = 0.04;
constexpr double kMostMove_m = 1.2;
constexpr double kFromStart = 0.3;  // of other routes
constexpr double kFar_m = 1e9;
constexpr double kSame = 0.2;       // shares of the kinds of change: the same route in another style,
constexpr double kLeaveOut = 0.3;   // without a point,
constexpr double kPutIn = 0.42;     // with one more; all others: a point is moved
constexpr double kWithNext = 0.35;  // with the next one
constexpr double kRestyled = 0.3;   // of those, in another style as well

double sum_m(const Route& route, std::size_t from = 0) {
  double length = 0.0;
  for (std::size_t k = from + 1; k < route.size(); ++k)
    length += geometry::distance(route[k - 1].at, route[k].at);
  return length;
}

// Before the point of the route that a change is about: another one, or where the drive begins.
RoutePoint point_before(const Route& route, const DriveMark& mark, std::size_t k) {
  if (mark.next == k) return {place_of(mark), mark.task, {}};
  return route[k - 1];
}

// How far a drive had come where so much of its route was left, from that mark on.
double length_at(const Drive& drive, std::size_t mark, double left_m) {
  for (std::size_t k = mark; k < drive.marks.size(); ++k)
    if (drive.marks[k].left_m <= left_m)
      return drive.marks[k].length_m - (k == mark ? 0.0 : left_m - drive.marks[k].left_m);
  return drive.marks.back().length_m;
}

}  // namespace

Shortener::Shortener(const SearchGround& ground, TaskStates states)
    : ground_(ground),
      states_(std::move(states)),
      driver_(ground.model(), ground.wide(), ground.walls(), ground.places(), states_) {}

// Null where there was no time for it.
RouteSearch* Shortener::routes(Clearance clearance) {
  auto& known = routes_[static_cast<std::size_t>(clearance)];
  if (known == nullptr) {
    const RouteGraph* const graph = ground_.graph(clearance, stop_);
    if (graph == nullptr) return nullptr;
    known = std::make_unique<RouteSearch>(*graph, states_, ground_.route_guide());
  }
  return known.get();
}

std::optional<DrivenRoute> Shortener::round(const ShortenRound& asked) {
  dice_.seed(asked.seed);
  stop_ = asked.stop;
  driver_.set_stop(stop_);
  std::optional<DrivenRoute> best;
  if (asked.best != nullptr) best = *asked.best;
  if (!best || asked.other_routes) {
    const std::uint64_t until = work() + kRoundWork;
    for (std::size_t n = 0; n < kMostOthers && (n == 0 || work() < until) && !stop_.over(); ++n)
      look_for_others(asked, best);
  } else {
    vary(*best);
  }
  was_cut_ = stop_.over();
  const bool is_shorter =
      best && (asked.best == nullptr || best->length_m() < asked.best->length_m() - kLeastGain_m);
  if (!is_shorter) best.reset();
  return best;
}

void Shortener::look_for_others(const ShortenRound& asked, std::optional<DrivenRoute>& best) {
  const TrainModel& model = ground_.model();
  RouteSearch* const ways = routes(asked.clearance);
  if (ways == nullptr) return;
  const bool is_whole = !best || asked.plain || chance() < kFromStart;
  const Point here{asked.start[kTrainX], asked.start[kTrainY]};
  DriveMark from = driver_.stand(asked.start, states_.next(states_.start(), ground_.places().label(here)));
  std::size_t mark = 0;
  if (!is_whole) {
    const auto& marks = best->drive.marks;
    mark = std::min(marks.size() - 1, static_cast<std::size_t>(chance() * static_cast<double>(marks.size())));
    from = marks[mark];
    if (states_.accepting(from.task)) return;
  }
  const double noise = asked.plain ? 0.0 : 0.15 * chance();
  const double turn_m = tightest_m(model) * (asked.plain ? 1.0 : chance());
  const double room = asked.plain ? 1.0 : 0.6 + 0.8 * chance();
  Route route = ways->route(route_query(model, from, turn_m, room, noise, dice_(), stop_));
  if (route.size() < 2) return;
  if (!asked.plain && chance() < (model.trailers == 0 ? 0.9 : 0.5)) {
    const RouteOptions& kept = ways->graph().options();
    const double spare_m = model.trailers == 0 ? 0.0 : chance() * (kept.wanted_m - kept.margin_m);
    route = ways->tightened(std::move(route), kept.margin_m + spare_m, stop_);
  }
  const double before_m = is_whole ? 0.0 : from.length_m;
  const double most_m = (best ? best->length_m() : kFar_m) - before_m;
  DriveStyle style;
  auto drive = best_along(route, from, most_m, style);
  if (!drive) return;
  if (is_whole) {
    from.left_m = sum_m(route);
    drive->marks.insert(drive->marks.begin(), from);
    best = DrivenRoute{asked.start, std::move(route), style, *std::move(drive)};
    return;
  }
  std::size_t offset = 0;
  Route whole = with_other_end(best->route, from, route, offset);
  best = DrivenRoute{asked.start, std::move(whole), style, joined(best->drive, mark, *drive, offset, 0)};
  // What was left before was left of another route.
  const double differs_m = sum_m(route) - from.left_m;
  for (std::size_t k = 0; k <= mark; ++k) best->drive.marks[k].left_m += differs_m;
}

// In some styles, the first one plain.
std::optional<Drive> Shortener::best_along(const Route& route, const DriveMark& from, double most_m,
                                           DriveStyle& style) {
  std::optional<Drive> best;
  const std::uint64_t until = work() + 2 * kRoundWork;
  for (std::size_t n = 0; n < kStyles && (n == 0 || work() < until) && !stop_.over(); ++n) {
    const DriveStyle tried = n == 0 ? plain_style(ground_.model()) : style_by_chance(ground_.model(), dice_);
    ++drives_;
    Drive drive =
        driver_.along(route, from, tried, [&](const DriveMark& mark) { return mark.length_m >= most_m; });
    if (drive.end != DriveEnd::Done || drive.marks.back().length_m >= most_m) continue;
    most_m = drive.marks.back().length_m;
    style = tried;
    best = std::move(drive);
  }
  return best;
}

void Shortener::vary(DrivenRoute& best) {
  const std::uint64_t until = work() + kRoundWork;
  for (std::size_t n = 0; n < kMostTries && work() < until && !stop_.over(); ++n) {
    const auto change = changed(best);
    if (!change || change->longer_m > kLongest_m) continue;
    const bool is_same = change->route.size() == best.route.size() && change->longer_m == 0.0;
    const DriveStyle style = is_same || chance() < kRestyled ? varied(best.style) : best.style;
    if (auto made = driven(best, *change, style)) best = *std::move(made);
  }
}

std::optional<Shortener::Change> Shortener::changed(const DrivenRoute& from) {
  const std::size_t count = from.route.size();
  if (count < 2) return std::nullopt;
  const double kind = chance();
  const std::size_t k =
      1 + std::min(count - 2, static_cast<std::size_t>(chance() * static_cast<double>(count - 1)));
  Change change{from.route, mark_before(from, k), 0, 0.0};
  const DriveMark& mark = from.drive.marks[change.mark];
  if (kind < kSame) {
    // Another style shows a few points on.
    constexpr std::size_t kShows = 3;
    change.shared = count > mark.next + kShows ? count - mark.next - kShows : 0;
    return change;
  }
  const RoutePoint before = point_before(from.route, mark, k);
  const bool is_done = kind < kLeaveOut ? leave_out(change, before, k)
                       : kind < kPutIn  ? put_in(change, before, k)
                                        : move(change, before, k);
  if (!is_done) return std::nullopt;
  change.longer_m = sum_m(change.route) - sum_m(from.route);
  return change;
}

// To anywhere near; states stay as they are.
bool Shortener::move(Change& change, const RoutePoint& before, std::size_t k) {
  Route& route = change.route;
  RouteSearch* const ways = routes(Clearance::Wanted);
  if (ways == nullptr) return false;
  const double far_m = kLeastMove_m * std::pow(kMostMove_m / kLeastMove_m, chance());
  const double along_m = far_m * bell();
  const Point by{along_m, far_m * bell()};
  // Now and then with its neighbour: how a place is come to and how it is left belong together.
  const std::size_t last = std::min(route.size() - 1, chance() < kWithNext ? k + 1 : k);
  RoutePoint from = before;
  for (std::size_t at = k; at <= std::min(last + 1, route.size() - 1); ++at) {
    const double share = at > last ? 0.0 : at == k ? 1.0 : 2.0 * chance() - 1.0;
    const auto here = ways->reached(from, route[at].at + share * by);
    if (!here || here->state != route[at].state) return false;
    route[at] = *here;
    from = route[at];
  }
  change.shared = route.size() - last - 1;
  return true;
}

bool Shortener::leave_out(Change& change, const RoutePoint& before, std::size_t k) {
  Route& route = change.route;
  RouteSearch* const ways = routes(Clearance::Wanted);
  if (ways == nullptr || k + 1 >= route.size() || !route[k].through.empty()) return false;
  const auto next = ways->reached(before, route[k + 1].at);
  if (!next || next->state != route[k + 1].state) return false;
  route[k + 1] = *next;
  route.erase(route.begin() + static_cast<std::ptrdiff_t>(k));
  change.shared = route.size() - k;
  return true;
}

bool Shortener::put_in(Change& change, const RoutePoint& before, std::size_t k) {
  Route& route = change.route;
  RouteSearch* const ways = routes(Clearance::Wanted);
  if (ways == nullptr) return false;
  const Point way = route[k].at - before.at;
  const double share = 0.15 + 0.7 * chance(), off_m = 0.3 * bell();
  const double length_m = std::max(0.01, std::hypot(way.x_m, way.y_m));
  const Point to = before.at + share * way + (off_m / length_m) * Point{-way.y_m, way.x_m};
  const auto added = ways->reached(before, to);
  if (!added || !added->through.empty()) return false;
  const auto next = ways->reached(*added, route[k].at);
  if (!next || next->state != route[k].state) return false;
  route[k] = *next;
  route.insert(route.begin() + static_cast<std::ptrdiff_t>(k), *added);
  change.shared = route.size() - k - 1;
  return true;
}

// The last mark at which the point still lies ahead as a whole, or one some metres before: who pulls trailers
// begins a turn early.
std::size_t Shortener::mark_before(const DrivenRoute& from, std::size_t point) {
  const auto& marks = from.drive.marks;
  const auto is_ahead = [&](const DriveMark& mark) {
    return mark.next < point || (mark.next == point && mark.seen == 0);
  };
  std::size_t last = 0;
  // The very last one is where the task was done.
  while (last + 2 < marks.size() && is_ahead(marks[last + 1])) ++last;
  const double reach = 6.0 + 0.7 * static_cast<double>(ground_.model().trailers);
  const auto back = static_cast<std::size_t>(chance() * reach);
  return last > back ? last - back : 0;
}

std::optional<DrivenRoute> Shortener::driven(const DrivenRoute& from, const Change& change,
                                             const DriveStyle& style) {
  const DriveMark& mark = from.drive.marks[change.mark];
  const Route tail = tail_of(change.route, mark);
  const double most_m = from.length_m() - kLeastGain_m;
  const std::size_t first_shared = tail.size() - std::min(change.shared, tail.size());
  const auto is_behind = [&](const DriveMark& now) {
    const double length_m = mark.length_m + now.length_m;
    if (length_m >= most_m) return true;
    return now.next > first_shared && length_m > length_at(from.drive, change.mark, now.left_m) + kSlack_m;
  };
  ++drives_;
  const Drive drive = driver_.along(tail, mark, style, is_behind);
  if (drive.end != DriveEnd::Done || mark.length_m + drive.marks.back().length_m >= most_m)
    return std::nullopt;
  DrivenRoute made{from.start, change.route, style,
                   joined(from.drive, change.mark, drive, mark.next - 1, mark.seen)};
  for (std::size_t k = 0; k <= change.mark; ++k) made.drive.marks[k].left_m += change.longer_m;
  return made;
}

DriveStyle Shortener::varied(DriveStyle style) {
  const TrainModel& model = ground_.model();
  const auto stretched = [this](double value, double low, double high) {
    return std::clamp(value * std::exp(0.3 * bell()), low, high);
  };
  style.lookahead_m = stretched(style.lookahead_m, 0.35, 3.0);
  style.tightest_m = stretched(style.tightest_m, least_turn_m(model), 3.0 * tightest_m(model));
  style.cruise_m_s = stretched(style.cruise_m_s, 0.6, std::max(0.6, model.most_speed_m_s));
  style.slowing = stretched(style.slowing, 1.0, 8.0);
  if (chance() < 0.2) style.side = static_cast<int>(3.0 * chance()) - 1;
  return style;
}

}  // namespace stepwright::ltl

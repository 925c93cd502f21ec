#include "supervisor/ltl/bound/point_bound.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>

#include "supervisor/ltl/guide/task.h"

namespace stepwright::ltl {

using geometry::Point;
using Clock = std::chrono::steady_clock;

namespace {

constexpr std::size_t kMostStates = 2'048;  // of a task's automaton: more take seconds

}  // namespace

std::optional<PointBound> PointBound::make(const Floor& floor, const RegionMap& map,
                                           const Automaton& automaton, const BoundOptions& options) {
  std::size_t corners = floor.border.ring.size();
  for (const Area& each : floor.obstacles) corners += each.ring.size();
  for (const Area& each : floor.propositions) corners += each.ring.size();
  if (corners > options.most_points) return std::nullopt;
  PointBound bound(floor, automaton);
  bound.cut(map, options.piece_m);
  if (bound.pieces_.size() + bound.sight_.corners().size() > options.most_points) return std::nullopt;
  if (bound.pieces_.size() * automaton.size() > options.most_states) return std::nullopt;
  if (!bound.look(options.until)) return std::nullopt;
  bound.close();
  for (const Label closed : bound.closed_) {
    if (bound.fields_.contains(closed)) continue;
    if (Clock::now() >= options.until) return std::nullopt;
    bound.fields_.emplace(closed, bound.field_of(closed));
  }
  bound.find_ways();
  return bound;
}

// Sides that lead from another label into a place.
void PointBound::cut(const RegionMap& map, double piece_m) {
  std::map<Label, std::vector<Piece>> by_label;
  for (const Region& region : map.regions()) {
    if (region.label == 0) continue;
    std::vector<Piece>& pieces = by_label[region.label];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t across = region.across[k];
      if (across == kNoRegion || map.region(across).label == region.label) continue;
      const Point from = map.points()[region.corners[k]], to = map.points()[region.corners[(k + 1) % 3]];
      const double side_m = geometry::distance(from, to);
      const double count = std::max(1.0, std::ceil(side_m / piece_m));
      for (double n = 0.5; n < count; n += 1.0)
        pieces.push_back({from + (n / count) * (to - from), 0.5 * side_m / count});
    }
  }
  for (const auto& [label, pieces] : by_label) {
    const auto first = static_cast<std::uint32_t>(pieces_.size());
    pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
    atoms_.push_back({label, first, static_cast<std::uint32_t>(pieces_.size())});
  }
}

// False when the time is over.
bool PointBound::look(Clock::time_point until) {
  const std::vector<Point>& corners = sight_.corners();
  corners_seen_.resize(corners.size());
  seen_.resize(pieces_.size());
  pieces_seen_.resize(pieces_.size());
  for (std::uint32_t a = 0; a < corners.size(); ++a) {
    if (Clock::now() >= until) return false;
    for (std::uint32_t b = a + 1; b < corners.size(); ++b) {
      const auto through = sight_.through(corners[a], corners[b]);
      if (!through) continue;
      const double length = geometry::distance(corners[a], corners[b]);
      corners_seen_[a].push_back({b, length, *through});
      corners_seen_[b].push_back({a, length, *through});
    }
  }
  for (std::uint32_t a = 0; a < pieces_.size(); ++a) {
    if (Clock::now() >= until) return false;
    const Point at = pieces_[a].middle;
    for (std::uint32_t b = 0; b < corners.size(); ++b)
      if (const auto through = sight_.through(at, corners[b]))
        seen_[a].push_back({b, geometry::distance(at, corners[b]), *through});
    for (std::uint32_t b = a; b < pieces_.size(); ++b) {
      const auto through = sight_.through(at, pieces_[b].middle);
      if (!through) continue;
      const double length = geometry::distance(at, pieces_[b].middle);
      pieces_seen_[a].push_back({b, length, *through});
      pieces_seen_[b].push_back({a, length, *through});
    }
  }
  return true;
}

// A place is closed where each label that has it breaks the task. If letters count, a label may stand twice
// in other places of the word: then none is.
void PointBound::close() {
  closed_.assign(automaton_.size(), 0);
  if (!stutter(automaton_).invariant) return;
  for (std::uint32_t state = 0; state < automaton_.size(); ++state) {
    Label broken = 0, open = 0;
    for (const Atom& atom : atoms_)
      (automaton_.rejecting(automaton_.next(state, atom.label)) ? broken : open) |= atom.label;
    closed_[state] = broken & ~open;
  }
}

PointBound::Field PointBound::field_of(Label closed) const {
  const std::size_t corners = sight_.corners().size(), pieces = pieces_.size();
  std::vector<double> between_m(corners * corners, kNever);
  for (std::size_t a = 0; a < corners; ++a) {
    between_m[a * corners + a] = 0.0;
    for (const Seen& each : corners_seen_[a])
      if ((each.through & closed) == 0) between_m[a * corners + each.to] = each.length_m;
  }
  // Floyd, Warshall (1962).
  for (std::size_t via = 0; via < corners; ++via) {
    for (std::size_t a = 0; a < corners; ++a) {
      const double first_m = between_m[a * corners + via];
      if (first_m == kNever) continue;
      for (std::size_t b = 0; b < corners; ++b)
        between_m[a * corners + b] =
            std::min(between_m[a * corners + b], first_m + between_m[via * corners + b]);
    }
  }
  Field field;
  field.to_corner_m.assign(pieces * corners, kNever);
  for (std::size_t a = 0; a < pieces; ++a) {
    double* const row = &field.to_corner_m[a * corners];
    for (const Seen& each : seen_[a]) {
      if ((each.through & closed) != 0) continue;
      for (std::size_t b = 0; b < corners; ++b)
        row[b] = std::min(row[b], each.length_m + between_m[each.to * corners + b]);
    }
  }
  field.legs_m.assign(pieces * pieces, kNever);
  for (std::size_t a = 0; a < pieces; ++a) {
    double* const row = &field.legs_m[a * pieces];
    for (const Seen& each : pieces_seen_[a])
      if ((each.through & closed) == 0) row[each.to] = std::min(row[each.to], each.length_m);
    for (const Seen& each : seen_[a]) {
      if ((each.through & closed) != 0) continue;
      for (std::size_t b = 0; b < pieces; ++b)
        row[b] = std::min(row[b], each.length_m + field.to_corner_m[b * corners + each.to]);
    }
    for (std::size_t b = 0; b < pieces; ++b)
      row[b] = std::max(0.0, row[b] - pieces_[a].half_m - pieces_[b].half_m);
  }
  return field;
}

// The state after that letter if it is another one and the task is not broken; else the same one.
std::uint32_t PointBound::next(std::uint32_t state, Label letter) const {
  const std::uint32_t next = automaton_.next(state, letter);
  return automaton_.rejecting(next) ? state : next;
}

// Dijkstra's search from acceptance backwards. Where a place is left, nothing is driven.
void PointBound::find_ways() {
  struct Change {
    std::uint32_t before = 0;
    std::int64_t atom = 0;  // -1: the letter without places
  };
  const std::size_t pieces = pieces_.size();
  std::vector<std::vector<Change>> changes(automaton_.size());
  for (std::uint32_t state = 0; state < automaton_.size(); ++state) {
    if (automaton_.accepting(state) || automaton_.rejecting(state)) continue;
    if (const std::uint32_t after = next(state, 0); after != state) changes[after].push_back({state, -1});
    for (std::size_t k = 0; k < atoms_.size(); ++k)
      if (const std::uint32_t after = next(state, atoms_[k].label); after != state)
        changes[after].push_back({state, static_cast<std::int64_t>(k)});
  }
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  to_go_m_.assign(automaton_.size() * pieces, kNever);
  const auto reach = [&](std::uint32_t state, std::size_t piece, double cost_m) {
    double& known_m = to_go_m_[state * pieces + piece];
    if (cost_m >= known_m) return;
    known_m = cost_m;
    open.emplace(cost_m, state * pieces + piece);
  };
  for (std::uint32_t state = 0; state < automaton_.size(); ++state)
    for (std::size_t piece = 0; piece < pieces && automaton_.accepting(state); ++piece)
      reach(state, piece, 0.0);
  while (!open.empty()) {
    const auto [known_m, node] = open.top();
    open.pop();
    if (known_m > to_go_m_[node]) continue;
    const std::size_t piece = node % pieces;
    for (const Change& change : changes[node / pieces]) {
      if (change.atom < 0) {
        reach(change.before, piece, known_m);
        continue;
      }
      const Atom& atom = atoms_[static_cast<std::size_t>(change.atom)];
      if (piece < atom.first || piece >= atom.end) continue;
      const Field& field = fields_.at(closed_[change.before]);
      for (std::size_t from = 0; from < pieces; ++from)
        reach(change.before, from, known_m + field.legs_m[piece * pieces + from]);
    }
  }
}

double PointBound::length_m(Point from, std::uint32_t state) const {
  const std::size_t corners = sight_.corners().size(), pieces = pieces_.size();
  double least_m = kNever;
  // Each letter without places may move the automaton on, where the point stands.
  for (std::size_t n = 0; n <= automaton_.size() && !automaton_.rejecting(state); ++n) {
    if (automaton_.accepting(state)) return 0.0;
    const Label closed = closed_[state];
    const Field& field = fields_.at(closed);
    std::vector<double> to_m(pieces, kNever);
    for (std::size_t k = 0; k < corners; ++k) {
      const auto through = sight_.through(from, sight_.corners()[k]);
      if (!through || (*through & closed) != 0) continue;
      const double first_m = geometry::distance(from, sight_.corners()[k]);
      for (std::size_t piece = 0; piece < pieces; ++piece)
        to_m[piece] = std::min(to_m[piece], first_m + field.to_corner_m[piece * corners + k]);
    }
    for (const Atom& atom : atoms_) {
      const std::uint32_t after = next(state, atom.label);
      for (std::uint32_t piece = atom.first; piece < atom.end && after != state; ++piece) {
        const auto through = sight_.through(from, pieces_[piece].middle);
        if (through && (*through & closed) == 0)
          to_m[piece] = std::min(to_m[piece], geometry::distance(from, pieces_[piece].middle));
        least_m = std::min(
            least_m, std::max(0.0, to_m[piece] - pieces_[piece].half_m) + to_go_m_[after * pieces + piece]);
      }
    }
    const std::uint32_t waited = next(state, 0);
    if (waited == state) break;
    state = waited;
  }
  return least_m;
}

std::optional<double> point_bound_m(const Problem& problem, const BoundOptions& options) {
  const auto map = make_regions(problem.floor, [&] { return Clock::now() >= options.until; });
  if (!map) return std::nullopt;
  auto task =
      read_task(problem.task, problem.places(), "task",
                {.most_states = kMostStates, .most_nodes = 400'000, .acceptance = Acceptance::Strong});
  if (!task) return std::nullopt;
  begin_behind(problem.read, task->automaton);
  const Point from = problem.start.position();
  const std::uint32_t region = map->locate(from);
  if (region == kNoRegion) return std::nullopt;
  const auto bound = PointBound::make(problem.floor, *map, task->automaton, options);
  if (!bound) return std::nullopt;
  const Automaton& automaton = task->automaton;
  const Label here = map->region(region).label;
  // No letter stands twice in a row.
  const bool is_read = !problem.read.empty() && problem.read.back() == here;
  return bound->length_m(from, is_read ? automaton.initial : automaton.next(automaton.initial, here));
}

}  // namespace stepwright::ltl

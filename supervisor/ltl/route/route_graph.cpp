#include "supervisor/ltl/route/route_graph.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

#include "supervisor/geometry/outline.h"
#include "supervisor/ltl/lanes/lanes.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kClose_m = 0.4;        // a place that near may be entered by who drives along
constexpr double kAtWall_m = 0.005;     // no way begins, ends or passes that near
constexpr double kLeastDepth_m = 1e-3;  // of a point in a narrow place
constexpr std::size_t kLongestWord = 12;

Point unit(Point v) {
  const double length = std::hypot(v.x_m, v.y_m);
  return length > 0.0 ? (1.0 / length) * v : Point{};
}

// Of a corner: outwards of an anticlockwise ring, halfway between its sides; nothing where it is no corner
// that bulges that way.
std::optional<Point> outwards(Point before, Point at, Point after) {
  const Point in = unit(at - before), out = unit(after - at);
  if (cross(in, out) < 1e-3) return std::nullopt;
  return unit(in - out);
}

}  // namespace

RouteGraph::RouteGraph(const Floor& floor, const Places& places, const Walls& walls,
                       const RouteOptions& options)
    : places_(places), walls_(walls), options_(options) {
  for (const Area& obstacle : floor.obstacles) add_corners(obstacle.ring, false);
  for (const Area& obstacle : floor.blocked) add_corners(obstacle.ring, false);
  add_corners(floor.border.ring, true);
  thin_out(0, options_.most_corners);
  add_places();
  connect();
  options_.stop = {};  // its flags are somebody else's
}

void RouteGraph::add(Point at, double margin_m) {
  if (walls_.clearance_m(at) < margin_m) return;
  points_.push_back(at);
  labels_.push_back(places_.label(at));
}

void RouteGraph::add_corners(const std::vector<Point>& outline, bool hole) {
  std::vector<Point> ring = outline;
  if ((geometry::signed_area_m2(ring) < 0.0) != hole) std::ranges::reverse(ring);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto out =
        outwards(ring[(k + ring.size() - 1) % ring.size()], ring[k], ring[(k + 1) % ring.size()]);
    if (!out) continue;
    for (const double distance : {options_.margin_m + 0.25, options_.wanted_m + 0.25})
      add(ring[k] + distance * *out, options_.margin_m);
  }
}

void RouteGraph::thin_out(std::size_t from, std::size_t most) {
  most = std::max<std::size_t>(most, 1);
  const std::size_t stride = (points_.size() - from + most - 1) / most;
  if (stride < 2) return;
  std::size_t kept = from;
  for (std::size_t k = from; k < points_.size(); k += stride, ++kept) {
    points_[kept] = points_[k];
    labels_[kept] = labels_[k];
  }
  points_.resize(kept);
  labels_.resize(kept);
}

// Along a side of an anticlockwise ring, within it; less deep where it is narrow.
void RouteGraph::add_side(std::span<const Point> ring, Point from, Point to) {
  const Point along = unit(to - from), inwards{-along.y_m, along.x_m};
  const auto count = static_cast<std::size_t>(std::ceil(geometry::distance(from, to) / options_.spread_m));
  for (std::size_t n = 0; n < count; ++n) {
    const double share = (static_cast<double>(n) + 0.5) / static_cast<double>(count);
    for (double depth = options_.depth_m; depth > kLeastDepth_m; depth *= 0.5) {
      const Point at = from + share * (to - from) + depth * inwards;
      if (!inside(ring, at)) continue;
      add(at, options_.margin_m);
      break;
    }
  }
}

void RouteGraph::add_places() {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    std::vector<Point> ring(places_.outline(k).begin(), places_.outline(k).end());
    if (geometry::signed_area_m2(ring) < 0.0) std::ranges::reverse(ring);
    const std::size_t before = points_.size();
    Point middle;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      middle = middle + (1.0 / static_cast<double>(ring.size())) * ring[i];
      add_side(ring, ring[i], ring[(i + 1) % ring.size()]);
    }
    if (inside(ring, middle)) add(middle, points_.size() == before ? 0.0 : options_.margin_m);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto out =
          outwards(ring[(i + ring.size() - 1) % ring.size()], ring[i], ring[(i + 1) % ring.size()]);
      if (out) add(ring[i] + (2.0 * kClose_m) * *out, options_.margin_m);
    }
    thin_out(before, options_.most_inner / places_.size());
  }
}

std::uint32_t RouteGraph::Words::number(const std::vector<Label>& word) {
  std::size_t first = 0;
  if (before != nullptr) {
    if (const auto known = before->numbers.find(word); known != before->numbers.end()) return known->second;
    first = before->all.size();
  }
  const auto [known, is_new] = numbers.try_emplace(word, static_cast<std::uint32_t>(first + all.size()));
  if (is_new) all.push_back(word);
  return known->second;
}

bool RouteGraph::read(Way& way, Point from, Point to, Words& words) const {
  const Label here = places_.label(from);
  std::vector<Label> letters;
  places_.read(from, to, here, letters);
  if (letters.size() > kLongestWord) return false;
  way.word = letters.empty() ? 0 : words.number(letters);
  way.near = places_.near(from, to, kClose_m) & ~here;
  return true;
}

std::optional<RouteGraph::Way> RouteGraph::way(Point from, Point to, Words& words) const {
  const double length = geometry::distance(from, to);
  const double least = std::min({options_.margin_m, walls_.clearance_m(from), walls_.clearance_m(to)});
  double cost = length;
  for (double done = 0.0; done < length;) {
    const double clear = walls_.clearance_m(from + (done / length) * (to - from));
    if (clear < least - 1e-9 || clear < kAtWall_m) return std::nullopt;
    // No wall is nearer than `clear`: a step as long as that cannot lead through one.
    const double step = std::min(length - done, std::max(std::min(0.15, clear), clear - least));
    const double short_m = options_.wanted_m - clear;
    if (short_m > 0.0) cost += step * options_.weight * short_m / options_.wanted_m;
    done += step;
  }
  Way found{.cost_m = cost, .length_m = length};
  if (!read(found, from, to, words)) return std::nullopt;
  return found;
}

std::vector<RouteGraph::Pair> RouteGraph::pairs_of(std::uint32_t from, Words& words) const {
  std::vector<Pair> pairs;
  for (std::uint32_t to = from + 1; to < points_.size() && !options_.stop.over(); ++to) {
    auto there = way(points_[from], points_[to], words);
    if (!there) continue;
    Way back = *there;
    there->to = to;
    back.to = from;
    const bool reads = there->word != 0 || there->near != 0 || labels_[from] != 0;
    if (reads && !read(back, points_[to], points_[from], words)) continue;
    pairs.push_back({*there, back});
  }
  return pairs;
}

// Words are numbered in the order of the points, whoever has found them.
void RouteGraph::connect() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  std::vector<std::vector<Pair>> rows(count);
  std::vector<std::size_t> by(count);
  std::array<Words, kLanes> words;
  std::atomic<std::uint32_t> next{0};
  on_lanes(options_.threads, [&](std::size_t lane) {
    for (std::uint32_t from = next++; from < count; from = next++) {
      rows[from] = pairs_of(from, words[lane]);
      by[from] = lane;
    }
  });
  std::vector<std::vector<Way>> ways(count);
  for (std::uint32_t from = 0; from < count; ++from) {
    const auto& read = words[by[from]].all;
    for (Pair& pair : rows[from]) {
      pair.there.word = words_.number(read[pair.there.word]);
      pair.back.word = words_.number(read[pair.back.word]);
      ways[from].push_back(pair.there);
      ways[pair.there.to].push_back(pair.back);
    }
  }
  first_.push_back(0);
  for (const auto& each : ways) {
    ways_.insert(ways_.end(), each.begin(), each.end());
    first_.push_back(static_cast<std::uint32_t>(ways_.size()));
  }
}

}  // namespace stepwright::ltl

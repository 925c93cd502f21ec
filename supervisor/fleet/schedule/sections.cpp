#include "supervisor/fleet/schedule/sections.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "supervisor/geometry/box_pairs.h"

namespace stepwright::fleet {

namespace {

// The least time from the entry of polygon `from` to the exit of its neighbour `to`.
std::int64_t entry_to_exit_ms(const TrajectoryEnvelope& envelope, std::uint32_t from, std::uint32_t to) {
  const auto& polygons = envelope.polygons;
  if (to + 1 == from) return polygons[to].overlap.least.count();
  const std::int64_t stay = polygons[from].stay.least.count();
  if (to == from) return stay;
  const std::int64_t overlap = polygons[from].overlap.least.count();
  return std::max<std::int64_t>(0, stay - overlap) + polygons[to].stay.least.count();
}

// Whether no times let the order change between the two pairs.
bool ordered_alike(const TrajectoryEnvelope& a, const TrajectoryEnvelope& b, const SpatialPair& p,
                   const SpatialPair& q) {
  const std::int64_t a_then_b =
      entry_to_exit_ms(b, p.b.polygon, q.b.polygon) + entry_to_exit_ms(a, q.a.polygon, p.a.polygon);
  const std::int64_t b_then_a =
      entry_to_exit_ms(a, p.a.polygon, q.a.polygon) + entry_to_exit_ms(b, q.b.polygon, p.b.polygon);
  return a_then_b > 0 && b_then_a > 0;
}

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t k) {
  while (parent[k] != k) k = parent[k] = parent[parent[k]];
  return k;
}

// Joins neighbours among the pairs of two vehicles, which begin at `first`.
void join_neighbours(std::span<const SpatialPair> pairs, std::uint32_t first, const TrajectoryEnvelope& a,
                     const TrajectoryEnvelope& b, std::vector<std::uint32_t>& parent) {
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    const SpatialPair& p = pairs[k];
    const auto join_row = [&](std::uint32_t row, std::uint32_t from_column) {
      const SpatialPair low{{p.a.vehicle, row}, {p.b.vehicle, from_column}};
      auto q = std::ranges::lower_bound(pairs.subspan(k + 1), low);
      for (; q != pairs.end() && q->a.polygon == row && q->b.polygon <= p.b.polygon + 1; ++q) {
        if (!ordered_alike(a, b, p, *q)) continue;
        parent[root(parent, first + static_cast<std::uint32_t>(q - pairs.begin()))] = root(parent, first + k);
      }
    };
    join_row(p.a.polygon, p.b.polygon + 1);
    join_row(p.a.polygon + 1, p.b.polygon == 0 ? 0 : p.b.polygon - 1);
  }
}

// Where the pairs of the same two vehicles end.
std::uint32_t end_of_vehicles(std::span<const SpatialPair> pairs, std::uint32_t first) {
  std::uint32_t end = first;
  while (end < pairs.size() && pairs[end].a.vehicle == pairs[first].a.vehicle &&
         pairs[end].b.vehicle == pairs[first].b.vehicle) {
    ++end;
  }
  return end;
}

}  // namespace

std::vector<SpatialPair> overlapping_pairs(std::span<const TrajectoryEnvelope> envelopes) {
  std::vector<geometry::Box> boxes;
  std::vector<std::uint32_t> vehicles;
  std::vector<PolygonRef> places;
  for (std::uint32_t v = 0; v < envelopes.size(); ++v) {
    for (std::uint32_t k = 0; k < envelopes[v].polygons.size(); ++k) {
      boxes.push_back(envelopes[v].polygons[k].area.bounds());
      vehicles.push_back(v);
      places.push_back({v, k});
    }
  }
  const auto area = [&](PolygonRef at) -> const geometry::ConvexPolygon& {
    return envelopes[at.vehicle].polygons[at.polygon].area;
  };
  std::vector<SpatialPair> pairs;
  for (const auto& [i, k] : geometry::overlapping_boxes(boxes, vehicles)) {
    if (geometry::overlaps(area(places[i]), area(places[k]))) pairs.push_back({places[i], places[k]});
  }
  std::ranges::sort(pairs, {}, [](const SpatialPair& p) {
    return std::tuple(p.a.vehicle, p.b.vehicle, p.a.polygon, p.b.polygon);
  });
  return pairs;
}

Sections merge_sections(std::vector<SpatialPair> pairs, std::span<const TrajectoryEnvelope> envelopes) {
  std::vector<std::uint32_t> parent(pairs.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (std::uint32_t first = 0; first < pairs.size();) {
    const std::uint32_t end = end_of_vehicles(pairs, first);
    join_neighbours(std::span(pairs).subspan(first, end - first), first, envelopes[pairs[first].a.vehicle],
                    envelopes[pairs[first].b.vehicle], parent);
    first = end;
  }
  // Sections in the order of their first pairs; roots are not always first ones.
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> section_of_root(pairs.size(), kNone);
  std::vector<std::uint32_t> section_of(pairs.size());
  Sections merged;
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    std::uint32_t& section = section_of_root[root(parent, k)];
    if (section == kNone) {
      section = static_cast<std::uint32_t>(merged.sections.size());
      merged.sections.push_back({pairs[k].a.vehicle, pairs[k].b.vehicle, 0, 0});
    }
    section_of[k] = section;
    ++merged.sections[section].pairs;
  }
  std::uint32_t next = 0;
  for (CriticalSection& section : merged.sections) {
    section.first_pair = next;
    next += section.pairs;
    section.pairs = 0;
  }
  merged.pairs.resize(pairs.size());
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    CriticalSection& section = merged.sections[section_of[k]];
    merged.pairs[section.first_pair + section.pairs++] = pairs[k];
  }
  return merged;
}

Sections unmerged_sections(std::vector<SpatialPair> pairs) {
  Sections sections;
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    sections.sections.push_back({pairs[k].a.vehicle, pairs[k].b.vehicle, k, 1});
  }
  sections.pairs = std::move(pairs);
  return sections;
}

void append_precedences(const Motion& motion, std::span<const SpatialPair> section, int side, Mode mode,
                        std::uint32_t label, std::vector<Constraint>& constraints) {
  const auto first_of = [&](const SpatialPair& p) { return side == 0 ? p.a : p.b; };
  const auto second_of = [&](const SpatialPair& p) { return side == 0 ? p.b : p.a; };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> orders;  // polygon of the second, of the first
  for (const SpatialPair& p : section) {
    const PolygonRef first = first_of(p), second = second_of(p);
    if (mode == Mode::Strict && (motion.last(first) || second.polygon == 0)) {
      // Nobody comes after who stays for ever, or before who was there first.
      constraints.push_back({kOrigin, motion.timepoint(second, Side::Entry), kHorizon_ms + 1, label});
      return;
    }
    orders.emplace_back(second.polygon, first.polygon);
  }
  // Who waits at a polygon for the exit of another one waits there for all exits before, too, and whoever
  // waits before a polygon waits before all later ones.
  std::ranges::sort(orders, [](const auto& x, const auto& y) {
    return x.first != y.first ? x.first < y.first : x.second > y.second;
  });
  std::int64_t done = -1;
  for (const auto& [entered, left] : orders) {
    if (static_cast<std::int64_t>(left) <= done) continue;
    done = left;
    const Timepoint exit = motion.timepoint({first_of(section.front()).vehicle, left}, Side::Exit);
    const Timepoint entry = motion.timepoint({second_of(section.front()).vehicle, entered}, Side::Entry);
    constraints.push_back({exit, entry, 0, label});
  }
}

}  // namespace stepwright::fleet

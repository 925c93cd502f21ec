#pragma once

// Critical sections: the polygons of different vehicles that overlap in space, and which of these pairs are
// one section.
//
// Two pairs (i, k), (i', k') of polygons of the same two vehicles with |i - i'| <= 1 and |k - k'| <= 1 must
// be ordered alike wherever the vehicles' least times leave no room for a change of order between them. Proof
// for "the first vehicle first at (i, k), the second first at (i', k')": e(i) <= s(k) and e(k') <= s(i'), and
// with the least distances s(k) -> e(k') and s(i') -> e(i) of one vehicle each, which are never negative for
// neighbours, this is a cycle; where its length is positive no times fit. Such pairs are joined; what is
// joined needs one decision for all and loses no schedule. The order itself stays pointwise, pair by pair, so
// that one vehicle may follow another through a section, one polygon behind.
//
// Pure functions; any thread.

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/schedule/motion.h"
#include "supervisor/fleet/schedule/problem.h"

namespace stepwright::fleet {

// a.vehicle < b.vehicle
struct SpatialPair {
  PolygonRef a;
  PolygonRef b;

  friend auto operator<=>(const SpatialPair&, const SpatialPair&) = default;
};

// All pairs of polygons of different vehicles that share inner points, ascending.
std::vector<SpatialPair> overlapping_pairs(std::span<const TrajectoryEnvelope> envelopes);

struct CriticalSection {
  std::uint32_t a = 0;  // the vehicles, a < b
  std::uint32_t b = 0;
  std::uint32_t first_pair = 0;
  std::uint32_t pairs = 0;
};

struct Sections {
  std::vector<SpatialPair> pairs;  // section by section
  std::vector<CriticalSection> sections;

  std::span<const SpatialPair> of(const CriticalSection& section) const {
    return std::span(pairs).subspan(section.first_pair, section.pairs);
  }
};

// `pairs` ascending.
Sections merge_sections(std::vector<SpatialPair> pairs, std::span<const TrajectoryEnvelope> envelopes);
// Each pair a section of its own: the reference for merging.
Sections unmerged_sections(std::vector<SpatialPair> pairs);

// Appends the constraints by which the first (side 0) or the second (side 1) vehicle comes first in the
// section, without those that follow from the others and the vehicles' own order of polygons.
void append_precedences(const Motion& motion, std::span<const SpatialPair> section, int side, Mode mode,
                        std::uint32_t label, std::vector<Constraint>& constraints);

}  // namespace stepwright::fleet

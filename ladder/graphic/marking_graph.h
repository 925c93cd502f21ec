#pragma once

// The markings of a token net (which places hold a token) that can be reached from the initial one, and how.
// Internal to this folder; a value, use from any thread.
//
// A place holds one token at most, as a step bit does: what enters a full place melts with what is there and
// is recorded as an overrun. In one scan all sources are cleared before the targets are set. Whatever fires
// together could as well fire one after the other, apart from transitions in a circle that all have their
// tokens: one by one they would melt, together they change places. So such a circle is an edge of its own.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ladder/graphic/token_net.h"

namespace stepwright::graphic {

using PlaceSet = std::vector<std::uint64_t>;  // a bit per place

bool contains(const PlaceSet& set, std::size_t place);

struct MarkingEdge {
  std::uint32_t transition =
      0;                 // index into TokenNet::transitions; of a circle one that has its own edge too
  std::uint32_t to = 0;  // index into MarkingGraph::markings
  bool overrun = false;  // the transition entered a full place
};

struct Overrun {
  std::uint32_t marking = 0;
  std::uint32_t transition = 0;
  std::uint32_t place = 0;
};

struct MarkingGraph {
  bool complete = true;            // false: the limit was met, markings are missing
  std::vector<PlaceSet> markings;  // in breadth-first order; [0] is the initial one
  std::vector<std::vector<MarkingEdge>> edges;
  std::vector<std::uint32_t> parent;           // over which a marking was first found; [0] its own
  std::vector<std::vector<std::uint32_t>> by;  // transitions, several where they fire together
  std::vector<Overrun> overruns;               // the first of each place
};

// At most `limit` markings.
MarkingGraph explore(const TokenNet& net, std::size_t limit);

// For every marking of a complete graph the places that can still be left, now or later.
std::vector<PlaceSet> places_to_leave(const TokenNet& net, const MarkingGraph& graph);

// The transitions on the way to a marking, oldest first; those of one scan together.
std::vector<std::vector<std::uint32_t>> way_to(const MarkingGraph& graph, std::uint32_t marking);

}  // namespace stepwright::graphic

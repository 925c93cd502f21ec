#pragma once

// Distances in one direction through a growing graph: the longest path from the source to each timepoint.
//
// The labels are a potential of the graph (no edge is violated), so that the effect of one more edge is found
// by Dijkstra's algorithm on the increases: each timepoint whose label grows is visited once, the one that
// grows most first (Ramalingam and Reps 1996; Cotton and Maler 2006, "Fast and flexible difference constraint
// propagation"). Not for use by several threads.

#include <cstdint>
#include <span>
#include <vector>

namespace stepwright::fleet::internal {

// An edge of the graph, seen in both directions; `next` links the edges that leave the same end.
struct Edge {
  std::uint32_t end[2];  // from, to
  std::uint32_t next[2];
  std::int32_t least_ms;
  std::uint32_t label;
};

inline constexpr std::uint32_t kNoEdge = 0xFFFFFFFF;

class Labels {
 public:
  // side 0 follows edges from `from` to `to` (earliest times), side 1 against them (what must still follow).
  Labels(int side, std::size_t timepoints, std::int32_t source_label);

  std::int32_t operator[](std::uint32_t timepoint) const { return label_[timepoint]; }
  void link(std::vector<Edge>& edges, std::uint32_t edge);
  void unlink(const std::vector<Edge>& edges, std::uint32_t edge);
  // Raises what the edge, already linked, makes larger. False on a cycle of positive length, on a rise of the
  // source or over the horizon: `cycle` then holds the edges that bring it about, and the labels are spoilt
  // until `undo`.
  bool propagate(const std::vector<Edge>& edges, std::uint32_t edge, std::vector<std::uint32_t>& cycle);
  // All edges at once, from labels that are too low: without the trail and the order by rises that single
  // edges need. False on what `propagate` fails on, or where it takes long to see that there is none of it:
  // labels are as before then. `most_visits` of timepoints.
  bool settle(const std::vector<Edge>& edges, std::size_t most_visits);
  // The edges that make the label what it is, last one first.
  void explain(const std::vector<Edge>& edges, std::uint32_t timepoint,
               std::vector<std::uint32_t>& path) const;

  struct Change {
    std::uint32_t timepoint;
    std::int32_t label_ms;  // before
    std::uint32_t cause;
  };
  std::span<const Change> changes() const { return changes_; }
  void undo(std::size_t changes);
  void forget_changes() { changes_.clear(); }

 private:
  struct Rise {
    std::int32_t by_ms;
    std::uint32_t timepoint;
    bool operator<(const Rise& other) const { return by_ms < other.by_ms; }
  };

  void offer(std::uint32_t timepoint, std::int32_t by_ms, std::uint32_t cause);
  void accept(const Rise& rise);
  void blame(const std::vector<Edge>& edges, std::uint32_t timepoint, std::uint32_t edge,
             std::vector<std::uint32_t>& cycle);

  bool raise_all(const std::vector<Edge>& edges, std::size_t most_visits);

  int side_;
  std::vector<std::int32_t> label_;
  std::vector<std::uint32_t> cause_;  // the edge that made the label; kNoEdge at first
  std::vector<std::uint32_t> head_;   // edges that leave the timepoint
  std::vector<Change> changes_;
  // Of the propagation that runs: what is known of each timepoint's rise, zero at rest.
  std::vector<std::int32_t> offered_ms_;
  std::vector<std::uint32_t> offered_cause_;
  std::vector<Rise> heap_;
};

}  // namespace stepwright::fleet::internal

#include "supervisor/fleet/network/network.h"

#include <cassert>
#include <limits>

namespace stepwright::fleet {

Network::Network(std::size_t timepoints)
    : timepoints_(timepoints), earliest_(0, timepoints, 0), remaining_(1, timepoints, kHorizon_ms) {}

void Network::link(const Constraint& constraint) {
  assert(constraint.least_ms >= -kHorizon_ms - 1 && constraint.least_ms <= kHorizon_ms + 1);
  const auto edge = static_cast<std::uint32_t>(edges_.size());
  edges_.push_back({.end = {constraint.from.value, constraint.to.value},
                    .next = {},
                    .least_ms = constraint.least_ms,
                    .label = constraint.label});
  earliest_.link(edges_, edge);
  remaining_.link(edges_, edge);
}

bool Network::load(std::span<const Constraint> constraints) {
  assert(!tracks_latest_);
  earliest_.forget_changes();
  const Mark before = mark();
  edges_.reserve(edges_.size() + constraints.size());
  for (const Constraint& constraint : constraints) link(constraint);
  // On a cycle of a millisecond it would go on up to the horizon.
  constexpr std::size_t kMostVisits = 64;
  if (earliest_.settle(edges_, kMostVisits * timepoints_)) return true;
  // One by one: which of them contradict each other.
  undo(before);
  return post(constraints);
}

bool Network::post(const Constraint& constraint) {
  const Mark before = mark();
  const auto edge = static_cast<std::uint32_t>(edges_.size());
  link(constraint);
  bool consistent = earliest_.propagate(edges_, edge, cycle_);
  if (consistent && tracks_latest_) {
    consistent = remaining_.propagate(edges_, edge, cycle_);
    assert(consistent && "earliest times that meet all constraints leave latest times");
  }
  if (consistent) return true;
  conflict_.clear();
  append_labels(cycle_, conflict_);
  // The path ends within the graph and is closed neither by itself nor by time zero.
  const std::uint32_t end = edges_[cycle_.front()].end[1];
  beyond_horizon_ = end != kOrigin.value && edges_[cycle_.back()].end[0] != end;
  undo(before);
  return false;
}

bool Network::post(std::span<const Constraint> constraints) {
  const Mark before = mark();
  for (const Constraint& constraint : constraints) {
    if (post(constraint)) continue;
    undo(before);
    return false;
  }
  return true;
}

std::vector<std::int32_t> Network::earliest_times() const {
  std::vector<std::int32_t> times(timepoints_);
  for (std::uint32_t t = 0; t < timepoints_; ++t) times[t] = earliest_[t];
  return times;
}

std::vector<std::int32_t> Network::latest_times() const {
  assert(tracks_latest_);
  std::vector<std::int32_t> times(timepoints_);
  for (std::uint32_t t = 0; t < timepoints_; ++t) times[t] = kHorizon_ms - remaining_[t];
  return times;
}

void Network::track_latest() {
  if (tracks_latest_) return;
  tracks_latest_ = true;
  [[maybe_unused]] const bool settled = remaining_.settle(edges_, std::numeric_limits<std::size_t>::max());
  assert(settled && "earliest times that meet all constraints leave latest times");
  earliest_.forget_changes();
}

void Network::append_labels(std::span<const std::uint32_t> path, std::vector<std::uint32_t>& labels) const {
  for (const std::uint32_t edge : path) labels.push_back(edges_[edge].label);
}

void Network::explain_earliest(Timepoint t, std::vector<std::uint32_t>& labels) const {
  std::vector<std::uint32_t> path;
  earliest_.explain(edges_, t.value, path);
  append_labels(path, labels);
}

void Network::explain_latest(Timepoint t, std::vector<std::uint32_t>& labels) const {
  std::vector<std::uint32_t> path;
  remaining_.explain(edges_, t.value, path);
  append_labels(path, labels);
}

Network::Mark Network::mark() const {
  return {edges_.size(), earliest_.changes().size(), remaining_.changes().size()};
}

void Network::undo(const Mark& mark) {
  earliest_.undo(mark.earliest_changes);
  remaining_.undo(mark.latest_changes);
  while (edges_.size() > mark.edges) {
    const auto edge = static_cast<std::uint32_t>(edges_.size() - 1);
    earliest_.unlink(edges_, edge);
    remaining_.unlink(edges_, edge);
    edges_.pop_back();
  }
}

}  // namespace stepwright::fleet

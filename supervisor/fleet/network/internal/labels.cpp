#include "supervisor/fleet/network/internal/labels.h"

#include <algorithm>
#include <utility>

#include "supervisor/fleet/network/constraint.h"

namespace stepwright::fleet::internal {

namespace {
constexpr std::uint32_t kSource = 0;
}

Labels::Labels(int side, std::size_t timepoints, std::int32_t source_label)
    : side_(side),
      label_(timepoints, 0),
      cause_(timepoints, kNoEdge),
      head_(timepoints, kNoEdge),
      offered_ms_(timepoints, 0),
      offered_cause_(timepoints, kNoEdge) {
  label_[kSource] = source_label;
}

void Labels::link(std::vector<Edge>& edges, std::uint32_t edge) {
  std::uint32_t& head = head_[edges[edge].end[side_]];
  edges[edge].next[side_] = head;
  head = edge;
}

void Labels::unlink(const std::vector<Edge>& edges, std::uint32_t edge) {
  head_[edges[edge].end[side_]] = edges[edge].next[side_];
}

void Labels::offer(std::uint32_t timepoint, std::int32_t by_ms, std::uint32_t cause) {
  if (by_ms <= offered_ms_[timepoint]) return;
  offered_ms_[timepoint] = by_ms;
  offered_cause_[timepoint] = cause;
  heap_.push_back({by_ms, timepoint});
  std::push_heap(heap_.begin(), heap_.end());
}

void Labels::accept(const Rise& rise) {
  const std::uint32_t timepoint = rise.timepoint;
  changes_.push_back({timepoint, label_[timepoint], cause_[timepoint]});
  label_[timepoint] += rise.by_ms;
  cause_[timepoint] = offered_cause_[timepoint];
  offered_ms_[timepoint] = 0;
}

bool Labels::propagate(const std::vector<Edge>& edges, std::uint32_t edge,
                       std::vector<std::uint32_t>& cycle) {
  const std::uint32_t from = edges[edge].end[side_];
  const std::uint32_t to = edges[edge].end[1 - side_];
  offer(to, label_[from] + edges[edge].least_ms - label_[to], edge);
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end());
    const Rise rise = heap_.back();
    heap_.pop_back();
    const std::uint32_t here = rise.timepoint;
    if (rise.by_ms != offered_ms_[here]) continue;  // a larger rise came after it was put here
    if (here == from || here == kSource || label_[here] + rise.by_ms > kHorizon_ms) {
      blame(edges, here, edge, cycle);
      return false;
    }
    accept(rise);
    for (std::uint32_t e = head_[here]; e != kNoEdge; e = edges[e].next[side_]) {
      const std::uint32_t next = edges[e].end[1 - side_];
      offer(next, label_[here] + edges[e].least_ms - label_[next], e);
    }
  }
  return true;
}

// The path that would raise `timepoint`, last edge first, back to where nothing but time zero holds it. If it
// meets the new edge a second time, then what lies between is a cycle that the heap had not come to yet.
void Labels::blame(const std::vector<Edge>& edges, std::uint32_t timepoint, std::uint32_t edge,
                   std::vector<std::uint32_t>& cycle) {
  cycle.clear();
  const bool closed = timepoint == edges[edge].end[side_];
  std::size_t after_edge = 0;
  std::uint32_t cause = offered_cause_[timepoint];
  while (cause != kNoEdge) {
    cycle.push_back(cause);
    if (cause == edge) {
      if (closed) break;
      if (after_edge != 0) {
        cycle.erase(cycle.begin(), cycle.begin() + static_cast<std::ptrdiff_t>(after_edge));
        break;
      }
      after_edge = cycle.size();
    }
    const std::uint32_t before = edges[cause].end[side_];
    cause = before == kSource ? kNoEdge : cause_[before];
  }
  offered_ms_[timepoint] = 0;
  for (const Rise& rise : heap_) offered_ms_[rise.timepoint] = 0;
  heap_.clear();
}

bool Labels::settle(const std::vector<Edge>& edges, std::size_t most_visits) {
  std::vector<std::int32_t> labels = label_;
  std::vector<std::uint32_t> causes = cause_;
  if (raise_all(edges, most_visits)) return true;
  label_ = std::move(labels);
  cause_ = std::move(causes);
  return false;
}

bool Labels::raise_all(const std::vector<Edge>& edges, std::size_t most_visits) {
  const auto size = static_cast<std::uint32_t>(label_.size());
  std::vector<std::uint32_t> queue;
  std::vector<char> queued(size, 1);
  queue.reserve(2 * label_.size());
  // Timepoints are mostly numbered along the way, so that one pass in their order settles most of them.
  for (std::uint32_t k = 0; k < size; ++k) queue.push_back(side_ == 0 ? k : size - 1 - k);
  // The source is seen by all: it comes first.
  if (side_ == 1) std::rotate(queue.begin(), queue.end() - 1, queue.end());
  for (std::size_t next_in_queue = 0; next_in_queue < queue.size(); ++next_in_queue) {
    if (next_in_queue == most_visits) return false;
    const std::uint32_t here = queue[next_in_queue];
    queued[here] = 0;
    for (std::uint32_t e = head_[here]; e != kNoEdge; e = edges[e].next[side_]) {
      const std::uint32_t next = edges[e].end[1 - side_];
      const std::int32_t label = label_[here] + edges[e].least_ms;
      if (label <= label_[next]) continue;
      if (next == kSource || label > kHorizon_ms) return false;
      label_[next] = label;
      cause_[next] = e;
      if (!queued[next]) queue.push_back(next);
      queued[next] = 1;
    }
  }
  return true;
}

void Labels::explain(const std::vector<Edge>& edges, std::uint32_t timepoint,
                     std::vector<std::uint32_t>& path) const {
  std::uint32_t cause = timepoint == kSource ? kNoEdge : cause_[timepoint];
  while (cause != kNoEdge) {
    path.push_back(cause);
    const std::uint32_t before = edges[cause].end[side_];
    cause = before == kSource ? kNoEdge : cause_[before];
  }
}

void Labels::undo(std::size_t changes) {
  while (changes_.size() > changes) {
    const Change& change = changes_.back();
    label_[change.timepoint] = change.label_ms;
    cause_[change.timepoint] = change.cause;
    changes_.pop_back();
  }
}

}  // namespace stepwright::fleet::internal

#pragma once

// A simple temporal network in milliseconds (Dechter, Meiri, Pearl 1991): least distances between timepoints,
// and with them the earliest and the latest time of each.
//
// Constraints are posted one by one. A post that contradicts what is there changes nothing and names the
// cycle of constraints that cannot all hold. What was posted last is taken back first, at the cost of what it
// had changed. Memory grows with timepoints and constraints; there is no matrix.
//
// Every timepoint lies between 0 and kHorizon_ms. All earliest times together meet every constraint, and so
// do all latest times. One thread at a time.
//
//   Network network(3);                                      // the origin and two more
//   network.post({kOrigin, a, 1000, 0});
//   const Network::Mark mark = network.mark();
//   if (!network.post({a, b, 5000, 1})) blame(network.conflict());
//   network.undo(mark);

#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/fleet/network/constraint.h"
#include "supervisor/fleet/network/internal/labels.h"

namespace stepwright::fleet {

class Network {
 public:
  // `timepoints` counts the origin.
  explicit Network(std::size_t timepoints);

  std::size_t timepoints() const { return timepoints_; }
  std::size_t constraints() const { return edges_.size(); }

  // False if the constraint contradicts the others; nothing has changed then but `conflict`.
  [[nodiscard]] bool post(const Constraint& constraint);
  // All of them, or none.
  [[nodiscard]] bool post(std::span<const Constraint> constraints);

  // All of them, or none, in less time: what was posted before and these cannot be taken back any more, marks
  // of before are void. Requires that latest times are not tracked yet.
  [[nodiscard]] bool load(std::span<const Constraint> constraints);

  // The labels of the constraints of the cycle behind the last false answer: it is closed by the fact
  // that no timepoint lies before 0, if `beyond_horizon` by the horizon, or by itself. A label may repeat.
  std::span<const std::uint32_t> conflict() const { return conflict_; }
  bool beyond_horizon() const { return beyond_horizon_; }

  std::int32_t earliest_ms(Timepoint t) const { return earliest_[t.value]; }
  // Requires track_latest.
  std::int32_t latest_ms(Timepoint t) const { return kHorizon_ms - remaining_[t.value]; }
  std::vector<std::int32_t> earliest_times() const;
  std::vector<std::int32_t> latest_times() const;

  // From here on posts keep the latest times up to date, too. What was posted before cannot be taken back
  // any more: marks of before are void.
  void track_latest();
  bool tracks_latest() const { return tracks_latest_; }

  // Appends the labels of constraints that alone bring the timepoint's bound about.
  void explain_earliest(Timepoint t, std::vector<std::uint32_t>& labels) const;
  void explain_latest(Timepoint t, std::vector<std::uint32_t>& labels) const;

  struct Mark {
    std::size_t edges = 0;
    std::size_t earliest_changes = 0;
    std::size_t latest_changes = 0;
  };
  Mark mark() const;
  // Back to what was when the mark was taken. Marks are used up last one first.
  void undo(const Mark& mark);

  // Calls back with each timepoint whose earliest (latest) time has changed since the mark, perhaps twice.
  template <typename Visitor>
  void each_later(const Mark& since, Visitor&& visit) const {
    for (const auto& change : earliest_.changes().subspan(since.earliest_changes)) {
      visit(Timepoint(change.timepoint));
    }
  }
  template <typename Visitor>
  void each_sooner(const Mark& since, Visitor&& visit) const {
    for (const auto& change : remaining_.changes().subspan(since.latest_changes)) {
      visit(Timepoint(change.timepoint));
    }
  }

 private:
  void link(const Constraint& constraint);
  void append_labels(std::span<const std::uint32_t> path, std::vector<std::uint32_t>& labels) const;

  std::size_t timepoints_;
  std::vector<internal::Edge> edges_;
  internal::Labels earliest_;
  // How much of the horizon must be left after each timepoint: the longest path to its end.
  internal::Labels remaining_;
  bool tracks_latest_ = false;
  bool beyond_horizon_ = false;
  std::vector<std::uint32_t> conflict_;
  std::vector<std::uint32_t> cycle_;
};

}  // namespace stepwright::fleet

#include "supervisor/fleet/schedule/retiming.h"

#include <algorithm>
#include <cassert>
#include <set>

namespace stepwright::fleet {

using std::chrono::milliseconds;

Retiming::Retiming(std::span<const TrajectoryEnvelope> envelopes,
                   std::span<const TemporalConstraint> constraints, const Schedule& made)
    : motion_(envelopes, constraints), network_(motion_.timepoints()), precedences_(made.precedences) {
  std::vector<Constraint> all(motion_.constraints().begin(), motion_.constraints().end());
  all.reserve(all.size() + precedences_.size());
  for (std::uint32_t k = 0; k < precedences_.size(); ++k) {
    const Timepoint exit = motion_.timepoint(precedences_[k].first, Side::Exit);
    const Timepoint entry = motion_.timepoint(precedences_[k].second, Side::Entry);
    all.push_back({exit, entry, 0, motion_.labels().precedences() + k});
  }
  [[maybe_unused]] const bool consistent = network_.load(all);
  assert(consistent && "these are the precedences of a schedule");
}

bool Retiming::not_before(TimepointRef timepoint, milliseconds time) {
  const auto ms = std::clamp<milliseconds::rep>(time.count(), 0, kHorizon_ms + 1);
  const auto last = static_cast<std::uint32_t>(precedences_.size());
  return network_.post({kOrigin, motion_.timepoint(timepoint.at, timepoint.side),
                        static_cast<std::int32_t>(ms), motion_.labels().precedences() + last});
}

milliseconds Retiming::earliest(TimepointRef timepoint) const {
  return milliseconds(network_.earliest_ms(motion_.timepoint(timepoint.at, timepoint.side)));
}

std::vector<VehicleTimes> Retiming::earliest() const {
  std::vector<VehicleTimes> all(motion_.vehicles());
  for (std::uint32_t v = 0; v < motion_.vehicles(); ++v) {
    for (std::uint32_t k = 0; k < motion_.polygons(v); ++k) {
      all[v].push_back({earliest({{v, k}, Side::Entry}), earliest({{v, k}, Side::Exit})});
    }
  }
  return all;
}

Retiming::Broken Retiming::broken() const {
  Broken broken;
  const MotionLabels& labels = motion_.labels();
  const std::set<std::uint32_t> cycle(network_.conflict().begin(), network_.conflict().end());
  for (const std::uint32_t label : cycle) {
    if (label < labels.temporal(0)) {
      if (label % 2 == 1) broken.slowest.push_back(label / 2);
    } else if (label < labels.precedences()) {
      broken.constraints.push_back(label - labels.temporal(0));
    } else if (label - labels.precedences() < precedences_.size()) {
      broken.precedences.push_back(precedences_[label - labels.precedences()]);
    }
  }
  return broken;
}

}  // namespace stepwright::fleet

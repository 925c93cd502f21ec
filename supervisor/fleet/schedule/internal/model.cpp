#include "supervisor/fleet/schedule/internal/model.h"

#include <algorithm>

namespace stepwright::fleet::internal {

SearchModel make_model(const Motion& motion, const Sections& sections, Mode mode,
                       const std::vector<char>& kept, std::span<const std::uint32_t> chosen) {
  SearchModel model;
  model.timepoints = motion.timepoints();
  model.first_literal_label = motion.labels().precedences();
  model.base.reserve(motion.constraints().size());
  for (const Constraint& c : motion.constraints()) {
    if (kept[c.label]) model.base.push_back(c);
  }
  model.entries.reserve(chosen.size());
  model.edge_begin.reserve(2 * chosen.size() + 1);
  model.edges.reserve(sections.pairs.size());
  for (std::uint32_t k = 0; k < chosen.size(); ++k) {
    const CriticalSection& section = sections.sections[chosen[k]];
    const auto pairs = sections.of(section);
    for (const int side : {0, 1}) {
      append_precedences(motion, pairs, side, mode, model.label_of(Literal::of(k, side)), model.edges);
      model.edge_begin.push_back(static_cast<std::uint32_t>(model.edges.size()));
    }
    const auto first_of_b = std::ranges::min_element(pairs, {}, [](const SpatialPair& p) { return p.b; });
    model.entries.push_back(
        {motion.timepoint(pairs.front().a, Side::Entry), motion.timepoint(first_of_b->b, Side::Entry)});
  }
  return model;
}

SearchObjective make_objective(const Motion& motion, const ScheduleOptions& options) {
  SearchObjective objective;
  if (options.objective == Objective::None) return objective;
  objective.measure = options.objective == Objective::Makespan ? Measure::Makespan : Measure::TotalTardiness;
  for (std::uint32_t v = 0; v < motion.vehicles(); ++v) {
    std::int64_t due = v < options.due.size() ? options.due[v].count() : kHorizon_ms;
    due = std::clamp<std::int64_t>(due, 0, kHorizon_ms);
    objective.ends.push_back(
        {motion.timepoint({v, motion.polygons(v) - 1}, Side::Exit), static_cast<std::int32_t>(due)});
  }
  return objective;
}

bool overlap_in_time(const Motion& motion, const Network& network, const SpatialPair& pair) {
  const auto at = [&](PolygonRef polygon, Side side) {
    return network.earliest_ms(motion.timepoint(polygon, side));
  };
  return at(pair.a, Side::Exit) > at(pair.b, Side::Entry) && at(pair.b, Side::Exit) > at(pair.a, Side::Entry);
}

}  // namespace stepwright::fleet::internal

#include "tests/bench/lattice/circle_envelopes.h"

#include <chrono>

namespace stepwright::bench {

namespace {

using Clock = std::chrono::steady_clock;

double since_ms(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

CircleEnvelopes::CircleEnvelopes(const fleet::VehicleModel& vehicle, const fleet::PrimitiveSet& primitives,
                                 const fleet::HeuristicTable& table, const fleet::EnvelopeOptions& options)
    : vehicle_(vehicle),
      floor_(support::circle_floor()),
      planner_(fleet::PathPlanner::create(floor_, vehicle, primitives, table).value()),
      options_(options) {}

const fleet::GrownEnvelope& CircleEnvelopes::of(const support::CircleTask& task) {
  const std::pair key{task.start.index(), task.goal.index()};
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  const auto begin = Clock::now();
  const auto answer = planner_.plan(task.start.pose(), task.goal.pose());
  path_ms_ += since_ms(begin);
  expanded_ += answer.expanded;
  length_m_ += answer.path.value().length_m;
  const auto planned = Clock::now();
  auto grown = fleet::grow_envelope(floor_, vehicle_.footprint(), "", answer.path->poses, options_).value();
  growth_ms_ += since_ms(planned);
  return known_.emplace(key, std::move(grown)).first->second;
}

}  // namespace stepwright::bench

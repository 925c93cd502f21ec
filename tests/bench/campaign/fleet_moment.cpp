#include "tests/bench/campaign/fleet_moment.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "plant_models/core/counter_random.h"
#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::campaign {
namespace {

using fleet::MissionProblem;

constexpr std::uint64_t kKinds = 4;
constexpr std::uint64_t kTenths = 2'120;  // of a second: the undisturbed job takes 212 s

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed, 901) {}

  std::uint64_t below(std::uint64_t count) { return random_.bits(draw_++) % count; }
  double tenths(std::uint64_t from, std::uint64_t count) {
    return 0.1 * static_cast<double>(from + below(count));
  }

 private:
  core::CounterRandom random_;
  std::uint64_t draw_ = 0;
};

// Between two places at which loads change hands.
void add_order(const MissionProblem& problem, Draw& draw, FleetMoment& moment) {
  std::vector<std::string> places;
  for (const fleet::MissionLocation& location : problem.locations) {
    if (location.service.count() > 0) places.push_back(location.name);
  }
  const std::size_t from = draw.below(places.size());
  const std::size_t to = (from + 1 + draw.below(places.size() - 1)) % places.size();
  moment.requests.push_back({moment.from_s, fleet::OrderChange{"order 44", places[from], places[to], 1}});
  moment.story = fmt::format("order from {} to {} at {:.1f} s", places[from], places[to], moment.from_s);
}

// Somebody reports a place and nobody hits anything there: what matters is where vehicles go from then on.
void add_block(const MissionProblem& problem, Draw& draw, FleetMoment& moment) {
  const fleet::GridFrame& frame = problem.map.frame();
  const double width_m = frame.resolution_m * frame.columns, height_m = frame.resolution_m * frame.rows;
  const geometry::Pose at{
      frame.origin.x_m + draw.tenths(20, static_cast<std::uint64_t>(10.0 * width_m) - 40),
      frame.origin.y_m + draw.tenths(20, static_cast<std::uint64_t>(10.0 * height_m) - 40),
      0.5 * std::numbers::pi * static_cast<double>(draw.below(2))};
  const auto area = geometry::footprint_at(at, {.front_m = 1.0, .rear_m = 1.0, .half_width_m = 0.75});
  moment.requests.push_back({moment.from_s, fleet::BlockChange{{"spill", area}}});
  moment.story = fmt::format("blocked at ({:.1f} m, {:.1f} m) at {:.1f} s", at.x_m, at.y_m, moment.from_s);
  if (draw.below(2) == 0) return;
  moment.until_s = moment.from_s + draw.tenths(100, 600);
  moment.requests.push_back({moment.until_s, fleet::UnblockChange{"spill"}});
  moment.story += fmt::format(", free at {:.1f} s", moment.until_s);
}

void add_death(const MissionProblem& problem, Draw& draw, FleetMoment& moment) {
  const std::size_t vehicle = draw.below(problem.vehicles.size());
  const std::string fault = fmt::format("dead_v{}", vehicle + 1);
  moment.vehicle = problem.vehicles[vehicle].name;
  moment.faults.push_back({moment.from_s, fault, 1.0});
  moment.story = fmt::format("{} at {:.1f} s", fault, moment.from_s);
  if (moment.kind == FleetKind::Death) return;
  const double mended_s = moment.from_s + draw.tenths(20, 200);
  moment.until_s = mended_s + draw.tenths(10, 200);
  moment.faults.push_back({mended_s, fault, 0.0});
  moment.requests.push_back({moment.until_s, fleet::ReturnChange{moment.vehicle}});
  moment.story += fmt::format(", mended at {:.1f} s, returns at {:.1f} s", mended_s, moment.until_s);
}

}  // namespace

FleetMoment fleet_moment(std::uint64_t seed, const fleet::MissionProblem& problem) {
  Draw draw(seed);
  FleetMoment moment;
  moment.seed = seed;
  moment.kind = static_cast<FleetKind>(seed % kKinds);
  moment.from_s = draw.tenths(1, kTenths);
  switch (moment.kind) {
    case FleetKind::Order:
      add_order(problem, draw, moment);
      break;
    case FleetKind::Block:
      add_block(problem, draw, moment);
      break;
    case FleetKind::Death:
    case FleetKind::Return:
      add_death(problem, draw, moment);
      break;
  }
  return moment;
}

const char* to_string(FleetKind kind) {
  switch (kind) {
    case FleetKind::Order:
      return "order";
    case FleetKind::Block:
      return "block";
    case FleetKind::Death:
      return "death";
    case FleetKind::Return:
      break;
  }
  return "return";
}

}  // namespace stepwright::campaign

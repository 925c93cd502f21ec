#include "supervisor/fleet/program/driving_times.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "supervisor/fleet/program/path_table.h"
#include "supervisor/fleet/program/wait_places.h"

namespace stepwright::fleet {
namespace {

// What it takes beyond the planned braking to come to a place, and to turn the wheel there.
constexpr double kRest_s = 1.5;

struct Instant {
  double arc_m = 0.0;
  double time_s = 0.0;
};

double service_s(const VehicleMission& mission, double arc_m) {
  double time = 0.0;
  for (const Stop& stop : mission.stops) {
    if (std::abs(stop.arc_m - arc_m) < 1e-6) time += 1e-3 * static_cast<double>(stop.service.count());
  }
  return time;
}

// The samples of the path with the time at which the vehicle passes them; two of one place where it rests.
std::vector<Instant> profile(const VehicleMission& mission, const ProgramOptions& options) {
  std::vector<Instant> made = {{0.0, 0.0}, {0.0, service_s(mission, 0.0)}};
  const std::vector<PathSample> samples = path_table(mission, options);
  double speed = 0.0;
  double time = made.back().time_s;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double way = samples[k].arc_m - samples[k - 1].arc_m;
    if (way <= 0.0) {
      time += kRest_s + service_s(mission, samples[k].arc_m);
      speed = 0.0;
    } else {
      const double next =
          std::min(samples[k].speed_m_s, std::sqrt(speed * speed + 2.0 * options.drive.speed_up_m_s2 * way));
      time += 2.0 * way / std::max(1e-3, speed + next);
      speed = next;
    }
    made.push_back({samples[k].arc_m, time});
  }
  const double end_m = mission.path.back().arc_m;
  if (end_m > 0.0) made.push_back({end_m, time + kRest_s + service_s(mission, end_m)});
  return made;
}

// When the vehicle comes to a place (`last` false), and when it goes on from there.
double time_at(const std::vector<Instant>& profile, double arc_m, bool last) {
  constexpr double kSame_m = 1e-6;
  std::size_t k = 0;
  const double wanted = last ? arc_m + kSame_m : arc_m - kSame_m;
  while (k + 1 < profile.size() && profile[k + 1].arc_m <= wanted) ++k;
  if (k + 1 == profile.size()) return profile.back().time_s;
  const Instant& a = profile[k];
  const Instant& b = profile[k + 1];
  const double part = b.arc_m > a.arc_m ? std::clamp((arc_m - a.arc_m) / (b.arc_m - a.arc_m), 0.0, 1.0) : 0.0;
  return a.time_s + part * (b.time_s - a.time_s);
}

std::chrono::milliseconds whole(double time_s) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(std::ceil(1e3 * std::max(0.0, time_s))));
}

}  // namespace

void set_driving_times(VehicleMission& mission, const ProgramOptions& options) {
  const std::vector<Instant> instants = profile(mission, options);
  auto& polygons = mission.grown.envelope.polygons;
  const auto& visits = mission.grown.visits;
  const WaitPlaces places = wait_places(mission, options.margins);
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const double leaves_s = time_at(instants, visits[k].exit_m, true);
    const auto set = [&](Bounds& bounds, double enters_m) {
      bounds.least = whole(leaves_s - time_at(instants, enters_m, false));
      bounds.most = std::max(bounds.most, bounds.least);
    };
    set(polygons[k].stay, visits[k].entry_m);
    if (k + 1 < polygons.size()) {
      set(polygons[k].overlap, visits[k + 1].entry_m);
      // Not at one instant: two vehicles that wait for each other would both be let go on.
      polygons[k].overlap.least = std::max(polygons[k].overlap.least, std::chrono::milliseconds(1));
      polygons[k].overlap.most = std::max(polygons[k].overlap.most, polygons[k].overlap.least);
    }
    polygons[k].left_into = static_cast<std::uint32_t>(places.left_into[k] - k);
  }
}

}  // namespace stepwright::fleet

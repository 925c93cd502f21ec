#include "supervisor/vehicle/path_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stepwright::vehicle {
namespace {

class Sampler {
 public:
  explicit Sampler(const SampleLimits& limits) : limits_(limits) {}

  void add(const PathLeg& leg) {
    const std::size_t first = samples_.size();
    const double way = leg.back().travel == geometry::Travel::Reverse ? -1.0 : 1.0;
    double heading = first == 0 ? leg.front().pose.heading_rad : samples_.back().pose.heading_rad;
    for (const geometry::PathPose& at : leg) {
      heading += std::remainder(at.pose.heading_rad - heading, 2.0 * std::numbers::pi);
      PathSample sample{.pose = {at.pose.x_m, at.pose.y_m, heading},
                        .arc_m = at.arc_m,
                        .rest_m = leg.back().arc_m,
                        .way = way};
      if (samples_.size() > first) {
        PathSample& before = samples_.back();
        before.curvature_1_m = way * (heading - before.pose.heading_rad) / (sample.arc_m - before.arc_m);
        sample.curvature_1_m = before.curvature_1_m;
      }
      samples_.push_back(sample);
    }
    limit_speeds(first);
  }

  std::vector<PathSample> take() { return std::move(samples_); }

 private:
  double lock_at(std::size_t first, double arc_m) const {
    std::size_t k = first;
    while (k + 1 < samples_.size() && samples_[k + 1].arc_m <= arc_m) ++k;
    return std::atan(limits_.wheelbase_m * samples_[k].curvature_1_m);
  }

  void limit_speeds(std::size_t first) {
    std::vector<SpeedStation> stations;
    for (std::size_t k = first; k < samples_.size(); ++k) {
      const double arc_m = samples_[k].arc_m;
      const double before = k > first ? std::abs(samples_[k - 1].curvature_1_m) : 0.0;
      stations.push_back({.sharpest_1_m = std::max(std::abs(samples_[k].curvature_1_m), before),
                          .turn_rad = lock_at(first, arc_m + kSteeringWindow_m / 2.0) -
                                      lock_at(first, arc_m - kSteeringWindow_m / 2.0),
                          .to_next_m = k + 1 < samples_.size() ? samples_[k + 1].arc_m - arc_m : 0.0});
    }
    const std::vector<double> speeds = greatest_speeds(stations, limits_.speed);
    for (std::size_t k = first; k < samples_.size(); ++k) samples_[k].speed_m_s = speeds[k - first];
  }

  const SampleLimits& limits_;
  std::vector<PathSample> samples_;
};

}  // namespace

std::vector<PathSample> path_samples(const std::vector<PathLeg>& legs, const SampleLimits& limits) {
  Sampler sampler(limits);
  for (const PathLeg& leg : legs) sampler.add(leg);
  return sampler.take();
}

}  // namespace stepwright::vehicle

#pragma once

// The way of a plan as a controller drives it: samples for MC_DrivePath, when it is where, and where along it
// the labels change. Trailers follow the car's way whatever the speed, so that the samples' speeds are chosen
// by what the drives can, not by the plan's.
//
// Pure functions; any thread. Example:
//   const TrainPlan at_rest = with_run_out(problem, answer->plan);
//   const TrainWay way = train_way(problem, at_rest, drive);

#include <vector>

#include "supervisor/ltl/scene/scene.h"
#include "supervisor/ltl/train/train_plan.h"
#include "supervisor/vehicle/path_samples.h"

namespace stepwright::ltl {

// How the train moves, as far as the plan does not say it.
struct TrainDrive {
  double top_speed_m_s = 1.2;
  double speed_up_m_s2 = 0.5;
  double brake_m_s2 = 0.5;       // planned with
  double hard_brake_m_s2 = 1.0;  // to keep to the plan
  double lateral_m_s2 = 0.6;     // of a curve, at most
  double lock_rate_rad_s = 0.5;
  double speed_lag_s = 0.3;  // of the drives, which set points make up for
  double lock_lag_s = 0.15;
  double sample_m = 0.1;  // between samples of the way
};

// A label that the car reads from here on.
struct WayLabel {
  Label label = 0;
  double arc_m = 0.0;
};

struct TrainWay {
  std::vector<vehicle::PathSample> samples;  // empty: it goes nowhere
  std::vector<double> times_s;               // of each sample, from a standstill at the first one
  std::vector<WayLabel> labels;              // the first one is that of the start
  double end_m = 0.0;

  // When the train is there.
  double time_at(double arc_m) const;
};

// The plan, and a piece straight on or along the last curve behind it in which it can come to rest: a plan
// ends where its task is done, at the edge of a place. As long as walls allow, at most `run_out_m`.
TrainPlan with_run_out(const Problem& problem, const TrainPlan& plan, double run_out_m = 0.8);

TrainWay train_way(const Problem& problem, const TrainPlan& plan, const TrainDrive& drive);

}  // namespace stepwright::ltl

#include "supervisor/ltl/planner/plan_way.h"

#include <algorithm>

#include "supervisor/ltl/train/train_motion.h"

namespace stepwright::ltl {

std::vector<WayState> way_of(const TrainModel& model, const TrainPlan& plan, double every_s) {
  std::vector<WayState> way = {{0.0, plan.start}};
  TrainMotion motion(model);
  TrainState state = plan.start;
  double begun_s = 0.0;
  for (const TrainPiece& piece : plan.pieces) {
    double done_s = 0.0;
    while (done_s < piece.duration_s) {
      const double stop_s = std::min(piece.duration_s, done_s + every_s);
      while (done_s < stop_s) done_s += motion.step(state, piece.control, stop_s - done_s);
      way.push_back({begun_s + done_s, state});
    }
    begun_s += piece.duration_s;
  }
  return way;
}

}  // namespace stepwright::ltl

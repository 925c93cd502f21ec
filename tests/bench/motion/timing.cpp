#include <algorithm>

#include "runtime/ground/result/value_or_throw.h"
#include "supervisor/motion/blend/blend.h"
#include "supervisor/motion/timing/plan_timing.h"
#include "tests/bench/motion/figures.h"
#include "tests/bench/motion/processor_time.h"
#include "tests/unit/supervisor/motion/timing/judge.h"

namespace stepwright::bench {

namespace {

using namespace motion;

struct TimedCase {
  tests::TimingCase problem;
  BlendedPath path;
  TimeLaw law;
};

TimedCase timed(Random& random, std::size_t points, std::size_t joints) {
  auto problem = tests::random_case(random, points, joints);
  auto path = result::value_or_throw(blend(problem.points, {.tolerance = problem.tolerance}));
  auto law = result::value_or_throw(plan_timing(path, problem.limits));
  return {std::move(problem), std::move(path), std::move(law)};
}

}  // namespace

TimingFigures measure_timing() {
  constexpr std::size_t kJudged = 2000, kBounded = 30;
  TimingFigures figures;
  Random random(1);
  std::vector<TimedCase> cases;
  for (std::size_t k = 0; k < kBounded; ++k) cases.push_back(timed(random, 10, 7));
  figures.blend_and_timing_ms = 1e3 / static_cast<double>(kBounded) * processor_seconds([&] {
                                  for (const TimedCase& each : cases) {
                                    const auto path =
                                        blend(each.problem.points, {.tolerance = each.problem.tolerance});
                                    result::value_or_throw(plan_timing(*path, each.problem.limits));
                                  }
                                });
  constexpr int kStraight = 1000;
  figures.straight_us =
      1e6 / kStraight * processor_seconds([&] {
        for (int k = 0; k < kStraight; ++k)
          result::value_or_throw(
              plan_straight(cases[0].problem.points[0], cases[0].problem.points[1], cases[0].problem.limits));
      });
  for (const TimedCase& each : cases) {
    const TimingBound bound = result::value_or_throw(bound_timing(each.path, each.problem.limits));
    const double ratio = each.law.duration() / bound.minimum, proved = each.law.duration() / bound.seconds;
    constexpr double kShare = 1.0 / kBounded;
    figures.mean_ratio += kShare * ratio;
    figures.worst_ratio = std::max(figures.worst_ratio, ratio);
    figures.mean_bound_ratio += kShare * proved;
    figures.worst_bound_ratio = std::max(figures.worst_bound_ratio, proved);
    figures.within_one_percent += bound.proved && proved <= 1.01 ? 100.0 * kShare : 0.0;
    figures.rows += static_cast<double>(each.law.rows.size()) / static_cast<double>(kBounded);
  }
  for (; figures.paths < kJudged; ++figures.paths) {
    const std::size_t points = 2 + random.below(6), joints = 1 + random.below(14);
    const TimedCase each = timed(random, points, joints);
    const double worst = tests::judge(each.path, each.law, each.problem.limits).worst;
    figures.worst_share = std::max(figures.worst_share, worst);
    if (worst > 1.0 + 1e-9) ++figures.violations;
  }
  return figures;
}

}  // namespace stepwright::bench

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include "tests/bench/lattice/circle_envelopes.h"
#include "tests/support/fleet/floor_maps.h"
using namespace stepwright;
using namespace stepwright::fleet;
using stepwright::bench::CircleEnvelopes;
using Clock = std::chrono::steady_clock;
static double ms(Clock::time_point a) {
  return std::chrono::duration<double, std::milli>(Clock::now() - a).count();
}
int main(int argc, char** argv) {
  const VehicleModel v;
  const PrimitiveSet primitives(v, {});
  auto t = Clock::now();
  const auto loaded =
      HeuristicTable::load_or_build(primitives, {.range_m = 41.0, .threads = 2}, "/tmp/wt/t41.table");
  std::printf("table 41 built %d %.0f ms\n", loaded.built, ms(t));
  for (double stretch : {3.0, 3.5}) {
    CircleEnvelopes circle(v, primitives, loaded.table, {.stretch_m = stretch});
    for (int n : {2, 10}) {
      std::size_t all = 0, most = 0;
      for (int run = 0; run < (argc > 1 ? std::atoi(argv[1]) : 10); ++run) {
        std::size_t p = 0;
        for (const auto& task : support::circle_problem(n, run)) p += circle.of(task).visits.size();
        all += p;
        most = std::max(most, p);
      }
      std::printf("stretch %.1f n %d mean/vehicle %.2f max %zu\n", stretch, n,
                  double(all) / n / (argc > 1 ? std::atoi(argv[1]) : 10), most);
    }
    std::printf("planned %zu, path %.3f ms each, growth %.3f ms each, length %.2f expanded %.0f\n",
                circle.planned(), circle.path_ms() / double(circle.planned()),
                circle.growth_ms() / double(circle.planned()), circle.length_m() / double(circle.planned()),
                double(circle.expanded()) / double(circle.planned()));
  }
}

#include <cstdio>
#include <cstdlib>
#include "tests/bench/shift/plant_run.h"
using namespace stepwright::bench::shift;
int main(int argc, char** argv) {
  ScenarioSettings s;
  if (argc > 1) s.vehicles = static_cast<std::uint32_t>(atoi(argv[1]));
  if (argc > 2) s.hours = atof(argv[2]);
  if (argc > 3) s.transports_per_hour = atof(argv[3]);
  if (argc > 4) s.seed = static_cast<std::uint64_t>(atoi(argv[4]));
  const Scenario scenario = draw_scenario(s);
  const PlantRun run = run_on_plant(scenario, true);
  for (const auto& l : run.log) std::puts(l.c_str());
  const auto& f = run.figures;
  std::size_t done = 0, late = 0, assigned = 0;
  for (std::size_t k = 0; k < f.deliveries.size(); ++k) {
    if (f.deliveries[k].assigned_s) ++assigned;
    if (!f.deliveries[k].delivered_s) continue;
    ++done;
    if (*f.deliveries[k].delivered_s > scenario.transports[k].due_s) ++late;
  }
  std::printf("failed '%s'\ntransports %zu assigned %zu done %zu late %zu\n", run.failed.c_str(),
              f.deliveries.size(), assigned, done, late);
  for (auto& c : run.collisions)
    std::printf("COLLISION %.2f v%u with %s\n", c.time_s, c.vehicle + 1, c.with.c_str());
  for (auto& c : run.deadlocks) std::printf("DEADLOCK %s\n", c.c_str());
  Spent a;
  for (auto& x : f.spent) {
    a.driving_s += x.driving_s;
    a.serving_s += x.serving_s;
    a.waiting_s += x.waiting_s;
    a.held_s += x.held_s;
    a.paused_s += x.paused_s;
    a.dead_s += x.dead_s;
    a.resting_s += x.resting_s;
  }
  std::printf("drive %.0f serve %.0f wait %.0f held %.0f pause %.0f dead %.0f rest %.0f\n", a.driving_s,
              a.serving_s, a.waiting_s, a.held_s, a.paused_s, a.dead_s, a.resting_s);
  for (auto& [n, t] : f.decisions.times)
    std::printf("%s: %zu p50 %.2f p99 %.2f max %.2f sum %.0f ms\n", n.c_str(), t.ms.size(), t.quantile(.5),
                t.quantile(.99), t.quantile(1), t.sum());
  for (auto& [n, t] : f.decisions.refused) std::printf("refused %s %u\n", n.c_str(), t);
  std::printf("retimes %zu p50 %.4f p99 %.4f max %.3f; kept %lu\n", f.retimes.ms.size(),
              f.retimes.quantile(.5), f.retimes.quantile(.99), f.retimes.quantile(1),
              f.decisions.orders_kept);
  std::printf(
      "lost %u contacts %u gap %.3f wait %.0f dev %.3f rerouted %u home %u waited %u\ncpu %.1f plant %.1f "
      "control %.1f judge %.1f; control steps %lu\n",
      run.lost, run.contacts, run.smallest_gap_m, run.longest_wait_s, run.largest_deviation_m, f.rerouted,
      f.sent_home, f.waited, f.cpu_s, f.plant_cpu_s, f.control_cpu_s, f.judge_cpu_s, run.control_steps);
}

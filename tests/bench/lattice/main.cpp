#include <chrono>
#include <cstdio>
#include <numbers>

#include "supervisor/fleet/lattice/path_planner.h"
#include "supervisor/fleet/map/map_file.h"
#include "tests/support/fleet/exact_outline.h"
#include "tests/support/fleet/floor_maps.h"

using namespace stepwright;
using namespace stepwright::fleet;
using Clock = std::chrono::steady_clock;
static double ms(Clock::time_point a) { return std::chrono::duration<double, std::milli>(Clock::now() - a).count(); }

static void ask(const char* name, const PathPlanner& planner, const OccupancyGrid& grid, geometry::Pose a, geometry::Pose b, PathOptions o) {
  auto t = Clock::now();
  const auto answer = planner.plan(a, b, o);
  const double took = ms(t);
  std::printf("%s w=%.1f h=%d: end %d %.2f ms, expanded %llu, %.1f MB", name, o.first_weight, int(o.heuristic), int(answer.end), took, (unsigned long long)answer.expanded, double(answer.peak_bytes) / 1e6);
  if (answer.path) std::printf(", length %.1f, cost %u, eps %.3f, hit %d", answer.path->length_m, answer.path->cost_mm, answer.epsilon, int(support::first_hit(grid, VehicleModel{}.footprint(), answer.path->poses).has_value()));
  std::puts("");
  for (auto& d : answer.diagnostics) std::puts(result::to_string(d).c_str());
  for (auto& i : answer.improvements) std::printf("    w %.2f cost %u eps %.3f exp %llu after %.2f ms\n", i.weight, i.cost_mm, i.epsilon, (unsigned long long)i.expanded, i.after.count());
}

int main() {
  const VehicleModel v;
  auto t = Clock::now();
  const PrimitiveSet primitives(v, {});
  std::printf("primitives %.1f ms\n", ms(t));
  for (int h : {0, 1}) for (auto& p : primitives.from(h)) std::printf("  %d->%d (%d,%d) %s len %.3f k %.3f/%.3f/%.3f cost %u\n", p.start_heading, p.end_heading, p.end.x, p.end.y, p.travel == geometry::Travel::Forward ? "F" : "R", p.length_m, p.segments[0].curvature_1pm, p.segments[1].curvature_1pm, p.segments[2].curvature_1pm, p.cost_mm);
  t = Clock::now();
  const SweptCells cells(v, primitives, 1);
  std::printf("swept %.1f ms\n", ms(t));
  std::printf("detour %.4f\n", detour_of(primitives) / 65536.0);
  for (unsigned n : {1u, 2u}) {
    t = Clock::now();
    const auto table = HeuristicTable::build(primitives, {.threads = n});
    std::printf("table %u threads %.1f ms\n", n, ms(t));
  }
  const auto table = HeuristicTable::load_or_build(primitives, {}, "/tmp/wt/t.table").table;
  t = Clock::now();
  HeuristicTable::load_or_build(primitives, {}, "/tmp/wt/t.table");
  std::printf("load %.2f ms\n", ms(t));
  const OccupancyGrid empty({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 250});
  {
    auto planner = PathPlanner::create(empty, v, primitives, table).value();
    for (double w : {1.0, 1.2, 3.0}) {
      ask("empty ", planner, empty, {45, 25, 0}, {8.82, 36.756, std::numbers::pi / 4}, {.first_weight = w});
      ask("empty2", planner, empty, {45, 25, std::numbers::pi}, {5, 25, std::numbers::pi}, {.first_weight = w});
    }
  }
  for (int seed = 1; seed <= 1; ++seed) {
    const auto mine = support::draw_mine(seed);
    (void)write_map(mine.grid, "/tmp/wt/mine" + std::to_string(seed) + ".yaml");
    t = Clock::now();
    auto planner = PathPlanner::create(mine.grid, v, primitives, table).value();
    std::printf("planner %.1f ms\n", ms(t));
    for (double w : {1.0, 1.5, 2.0, 3.0}) for (auto h : {Heuristic::Combined}) for (auto [a, b] : {std::pair{0, 9}, {4, 5}})
      ask("mine", planner, mine.grid, mine.stations[a], mine.stations[b], {.first_weight = w, .heuristic = h, .deadline = Clock::now() + std::chrono::seconds(5)});
  }
  const auto w = support::draw_warehouse(1);
  (void)write_map(w.grid, "/tmp/wt/warehouse.yaml");
  auto planner = PathPlanner::create(w.grid, v, primitives, table).value();
  for (double wt : {1.0, 3.0}) for (auto h : {Heuristic::Combined})
      ask("wh", planner, w.grid, w.stations[0], w.stations.back(), {.first_weight = wt, .heuristic = h, .deadline = Clock::now() + std::chrono::seconds(5)});
}

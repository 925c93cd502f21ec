// The tank bench of tests/cells/bench, larger: more vehicles and distributors, the same domain.

#include <algorithm>
#include <cstdlib>

#include "supervisor/pddl/task/task.h"
#include "tests/bench/planner/generators/catalogue.h"
#include "tests/bench/planner/generators/problem_text.h"

namespace stepwright::bench {
namespace {

constexpr int kFull = 10;
constexpr int kCritical = 2;  // of the vehicles and of the distributors

struct Distributor {
  int x, y, level, demand, wanted;
};

int distance(int ax, int ay, int bx, int by) {
  return std::max(1, std::abs(ax - bx) + std::abs(ay - by));
}

// Vehicle 1 serves one distributor after the other; the supplier is at (0, 0).
struct Vehicle {
  int level = kCritical;
  int at = 0;  // 0 is the supplier
  std::vector<std::string> plan = {};

  static std::string place(int p) { return p == 0 ? "f1" : fmt::format("a{}", p); }

  void go(int to) {
    if (at != to) plan.push_back(fmt::format("move v1 {} {}", place(at), place(to)));
    at = to;
  }
  // Raises the distributor by `amount`, with as many trips as that takes.
  void bring(int to, int amount) {
    while (amount > 0) {
      const int batch = std::min(amount, kFull - kCritical);
      if (level - kCritical < batch) {
        go(0);
        plan.push_back(fmt::format("load v1 f1 level{}", batch - (level - kCritical)));
        level = batch + kCritical;
      }
      go(to);
      plan.push_back(fmt::format("unload v1 a{} level{}", to, batch));
      level -= batch;
      amount -= batch;
    }
  }
};

void serve(Vehicle& vehicle, int number, Distributor d) {
  const auto deliver = [&](const char* action, int amount) {
    if (d.level - amount < kCritical) {
      vehicle.bring(number, amount + kCritical - d.level);
      d.level = amount + kCritical;
    }
    vehicle.plan.push_back(fmt::format("{0} a{1} c{1} level{2}", action, number, amount));
    d.level -= amount;
  };
  constexpr int kMost = kFull - kCritical;
  if (d.demand <= kMost) {
    deliver("complete_order", d.demand);
  } else {
    deliver("partial_order", kMost);
    deliver("final_order", d.demand - kMost);
  }
  vehicle.bring(number, d.wanted - d.level);
}

Draft draft(int vehicles, int distributors, Random& random) {
  ProblemText problem(fmt::format("tank-bench-{}-{}", vehicles, distributors), "tank-bench");
  problem.objects("vehicle", numbered("v", vehicles));
  problem.objects("supplier", {"f1"});
  problem.objects("distributor", numbered("a", distributors));
  problem.objects("client", numbered("c", distributors));
  problem.objects("leveltransf", numbered("level", kFull));
  problem.init("(= (distance-travelled) 0) (= (transport-cost) 0) (= (postponed) 0)");
  for (int l = 1; l <= kFull; ++l) problem.init("(= (amount level{0}) {0})", l);
  for (int v = 1; v <= vehicles; ++v) {
    problem.init("(is-at v{0} f1) (= (lev v{0}) {1}) (= (maxlevel v{0}) {2}) (= (critical v{0}) {1})", v,
                 kCritical, kFull);
    problem.goal("(is-at v{} f1)", v);
  }
  std::vector<Distributor> all;
  Vehicle vehicle;
  int postponed = 0;
  for (int d = 1; d <= distributors; ++d) {
    const int x = random.between(-4, 4), y = random.between(-4, 4);
    const int level = random.between(kCritical, 4), demand = random.between(5, 10);
    all.push_back({x, y, level, demand, random.between(4, 7)});
    problem.init(
        "(serves a{0} c{0}) (= (level a{0}) {1}) (= (max-level a{0}) {2}) (= (critical-level a{0}) {3}) "
        "(= (demand c{0}) {4}) (= (received c{0}) 0)",
        d, level, kFull, kCritical, demand);
    problem.goal("(= (level a{0}) {1}) (>= (received c{0}) (demand c{0}))", d, all.back().wanted);
    serve(vehicle, d, all.back());
    postponed += std::max(0, demand - (kFull - kCritical));
  }
  vehicle.go(0);
  int farthest = 0;
  for (int a = 1; a <= distributors; ++a) {
    const Distributor& from = all[static_cast<std::size_t>(a - 1)];
    const int out = distance(0, 0, from.x, from.y);
    farthest = std::max(farthest, out);
    problem.init("(= (distance f1 a{0}) {1}) (= (distance a{0} f1) {1})", a, out);
    for (int b = 1; b <= distributors; ++b) {
      const Distributor& to = all[static_cast<std::size_t>(b - 1)];
      if (a != b) problem.init("(= (distance a{} a{}) {})", a, b, distance(from.x, from.y, to.x, to.y));
    }
  }
  problem.metric("minimize (+ (distance-travelled) (* 50 (postponed)))");
  // Some vehicle goes to the farthest distributor and back, and none delivers more at once than it can hold
  // above its critical level.
  return {problem.text(), vehicle.plan, 2.0 * farthest + 50.0 * postponed};
}

}  // namespace

Generator tank_bench(int vehicles) {
  const std::string path = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/bench/domain.pddl";
  const auto domain = pddl::read_source(path);
  return {fmt::format("tank_bench_{}", vehicles),
          fmt::format("the cell's domain with {} vehicle{}", vehicles, vehicles == 1 ? "" : "s"),
          domain ? domain->text : std::string(),
          {2, 3, 4, 6, 9, 12},
          60,
          false,
          [vehicles](int size, Random& random) { return draft(vehicles, size, random); }};
}

}  // namespace stepwright::bench

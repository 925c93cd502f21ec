#include "tests/bench/planner/generators/catalogue.h"

namespace stepwright::bench {

std::vector<Generator> generators() {
  return {logistics(),    depots(),      blocks(),      courier(),     rovers(),          satellites(),
          zeno(),         sailing(),     counters(),    drone(),       warehouse_tanks(), job_shop(),
          sorting_line(), tank_bench(1), tank_bench(2), tank_bench(3), tank_bench(4),     canteen()};
}

}  // namespace stepwright::bench

#pragma once

// One function per domain; `generators()` of instance.h lists them all.
//
// Thread rule: pure functions.

#include "tests/bench/planner/generators/instance.h"

namespace stepwright::bench {

Generator blocks();
Generator canteen();
Generator counters();
Generator courier();
Generator depots();
Generator drone();
Generator job_shop();
Generator logistics();
Generator rovers();
Generator sailing();
Generator satellites();
Generator sorting_line();
Generator tank_bench(int vehicles);  // 1 .. 4; the size is the number of distributors
Generator warehouse_tanks();
Generator zeno();

}  // namespace stepwright::bench

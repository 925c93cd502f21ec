// The cost of a monitor in every scan, measured (monitor_cost.h).
//
//   bench_ltl_monitor [--json FILE]

#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/bench/ltl_monitor/monitor_cost.h"
#include "tests/bench/ltl_monitor/watched_program.h"

namespace stepwright::bench {
namespace {

int run(const char* json_file) {
  nlohmann::json out = nlohmann::json::object();
  const std::vector<EngineCost> costs = monitor_cost();
  for (const EngineCost& each : costs) {
    const std::string key = each.engine;
    out["monitor_" + key + "_us"] = each.monitor_us;
    out["hand_" + key + "_us"] = each.by_hand_us;
    out["without_" + key + "_us"] = each.without_us;
    std::printf("%-6s  monitor %.3f us a scan, IFs by hand %.3f us (ratio %.2f); the program alone %.3f us\n",
                each.engine, each.monitor_us, each.by_hand_us, each.monitor_us / each.by_hand_us,
                each.without_us);
  }
  out["monitor_us"] = most_us(costs);
  out["places"] = kPlaces;
  if (json_file == nullptr) return 0;
  std::ofstream file(json_file);
  file << out.dump(2) << "\n";
  return file.flush() ? 0 : 1;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  const bool has_json = argc == 3 && std::strcmp(argv[1], "--json") == 0;
  if (argc != 1 && !has_json) {
    std::fprintf(stderr, "usage: bench_ltl_monitor [--json FILE]\n");
    return 2;
  }
  try {
    return stepwright::bench::run(has_json ? argv[2] : nullptr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_ltl_monitor: %s\n", error.what());
    return 1;
  }
}

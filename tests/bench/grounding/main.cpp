// Grounding by joins beside grounding by enumeration, on generated instances of 10 to 10,000 objects, and
// what the tank bench costs from its files to the ground task. CPU times: they compare on a busy machine.
//
//   bench_grounding [--most N] [--seconds S] [--memory-mb M] [--only NAME] [--json FILE]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/pddl/grounding/grounder.h"
#include "tests/bench/grounding/enumerating_grounder.h"
#include "tests/bench/grounding/measure.h"

namespace stepwright::bench::grounding {
namespace {

pddl::GroundTask joining(const pddl::Definition& definition, const std::function<bool()>& stop) {
  return pddl::ground_task(definition, stop);
}

using result::ExitCode;

struct Arguments {
  int most = 10000;
  Limits limits;
  std::string only;
  std::string json_file;
};

std::string seconds(const Measured& measured) {
  char text[40];
  std::snprintf(text, sizeof(text), "%9.4f %7.0f", measured.ground_s, measured.peak_mb);
  return measured.done ? text : "        -       -";
}

nlohmann::json to_json(const Instance& instance, int objects, const Measured& joined,
                       const Measured& enumerated) {
  const auto times = [](const Measured& m) {
    nlohmann::json json;
    json["done"] = m.done;
    json["parse_cpu_s"] = m.parse_s;
    json["ground_cpu_s"] = m.ground_s;
    json["peak_mb"] = m.peak_mb;
    return json;
  };
  nlohmann::json json;
  json["domain"] = instance.name;
  json["objects"] = objects;
  json["operators"] = joined.operators;
  json["facts"] = joined.facts;
  json["groups"] = joined.groups;
  json["joined"] = times(joined);
  json["enumerated"] = times(enumerated);
  return json;
}

nlohmann::json curve(Generator generator, const Arguments& arguments) {
  nlohmann::json rows = nlohmann::json::array();
  bool old_ended = false, new_ended = false;
  for (const int objects : {10, 30, 100, 300, 1000, 3000, 10000}) {
    if (objects > arguments.most || new_ended) break;
    const Instance instance = generator(objects);
    if (!arguments.only.empty() && instance.name != arguments.only) break;
    const Measured joined = measure(instance, joining, arguments.limits);
    Measured enumerated;
    if (!old_ended) {
      enumerated = measure(instance, &pddl::baseline::ground_by_enumeration, arguments.limits);
    }
    old_ended = old_ended || !enumerated.done;
    new_ended = !joined.done;
    std::printf("%-10s %6d %9zu %8zu %8zu %8.4f | %s | %s", instance.name.c_str(), objects, joined.operators,
                joined.facts, joined.groups, joined.parse_s, seconds(joined).c_str(),
                seconds(enumerated).c_str());
    // Shorter times are below the resolution of the clock.
    if (enumerated.done && joined.ground_s > 1e-3) {
      std::printf(" | %6.1f", enumerated.ground_s / joined.ground_s);
    }
    if (joined.done && enumerated.done && joined.operators != enumerated.operators) {
      std::printf("  %zu operators by enumeration", enumerated.operators);
    }
    std::printf("\n");
    std::fflush(stdout);
    rows.push_back(to_json(instance, objects, joined, enumerated));
  }
  return rows;
}

double now_ms() {
  return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Reading, parsing and grounding of the tank bench, the median of many.
nlohmann::json tank_bench() {
  const std::string folder = std::string(STEPWRIGHT_SOURCE_DIR) + "/tests/cells/bench/";
  std::vector<double> joined, enumerated;
  const auto run = [&](Ground ground, std::vector<double>& times) {
    const double start = now_ms();
    const auto task = pddl::load_task(folder + "domain.pddl", folder + "problem.pddl");
    if (!task) std::exit(1);
    const pddl::GroundTask found = ground(task->definition(), [] { return false; });
    times.push_back(now_ms() - start);
    if (found.operators.empty()) std::exit(1);
  };
  for (int i = 0; i < 101; ++i) {
    run(joining, joined);
    run(&pddl::baseline::ground_by_enumeration, enumerated);
  }
  std::sort(joined.begin(), joined.end());
  std::sort(enumerated.begin(), enumerated.end());
  std::printf("tank bench, files to ground task, CPU ms: joined %.3f (worst %.3f), enumerated %.3f\n",
              joined[50], joined.back(), enumerated[50]);
  nlohmann::json json;
  json["joined_cpu_ms"] = joined[50];
  json["joined_worst_cpu_ms"] = joined.back();
  json["enumerated_cpu_ms"] = enumerated[50];
  return json;
}

int run(const Arguments& arguments) {
  nlohmann::json json;
  json["tank_bench"] = tank_bench();
  std::printf("%-10s %6s %9s %8s %8s %8s | %9s %7s | %9s %7s | %6s\n", "domain", "objs", "operators", "facts",
              "groups", "parse s", "joined s", "MB", "enum. s", "MB", "ratio");
  for (const Generator generator : generators()) {
    for (const nlohmann::json& row : curve(generator, arguments)) json["instances"].push_back(row);
  }
  if (!arguments.json_file.empty()) std::ofstream(arguments.json_file) << json.dump(2) << "\n";
  return 0;
}

}  // namespace
}  // namespace stepwright::bench::grounding

int main(int argc, char** argv) {
  using namespace stepwright;
  bench::grounding::Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (i + 1 == argc) {
      std::fprintf(
          stderr,
          "usage: bench_grounding [--most N] [--seconds S] [--memory-mb M] [--only NAME] [--json FILE]\n");
      return static_cast<int>(result::ExitCode::Usage);
    }
    const char* value = argv[++i];
    if (option == "--most") arguments.most = std::atoi(value);
    if (option == "--seconds") arguments.limits.seconds = std::atof(value);
    if (option == "--memory-mb") arguments.limits.memory_mb = static_cast<std::size_t>(std::atoll(value));
    if (option == "--only") arguments.only = value;
    if (option == "--json") arguments.json_file = value;
  }
  return bench::grounding::run(arguments);
}

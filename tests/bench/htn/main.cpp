// bench_htn: how long task planning takes. The demonstrations and problems of Karlsson et al. 2012 with a
// stand-in for geometry (the paper: at most 5 ms each), and trucks that bring packages, larger and larger:
// on a ring beside SHOP2 as it is printed (plain_decomposition.h), on a square with roads both ways, where
// that goes round in circles, until the time is up.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "runtime/ground/result/exit_code.h"
#include "supervisor/htn/plan/validate.h"
#include "supervisor/htn/search/search.h"
#include "supervisor/htn/task/read_task.h"
#include "tests/bench/htn/plain_decomposition.h"
#include "tests/support/htn/table_geometry.h"
#include "tests/support/htn/transport.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;
using htn::test::TableGeometry;
using htn::test::TableLimits;

constexpr int kRuns = 301;
constexpr std::chrono::seconds kBaselineTime{2};

double ms_since(Clock::time_point began) {
  return std::chrono::duration<double, std::milli>(Clock::now() - began).count();
}

double middle(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

lisp::Source file(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(STEPWRIGHT_SOURCE_DIR "/tests/cells/htn/" + name + ".hddl").rdbuf();
  return {name + ".hddl", text.str()};
}

TableLimits limits_of(const std::string& problem) {
  if (problem == "d1") return {{{"left", {"table", "red-region"}}, {"right", {"table"}}}, {}};
  if (problem == "d2")
    return {{{"left", {"gray-region", "red-region"}}, {"right", {"table", "green-region", "gray-region"}}},
            {}};
  if (problem == "p1") return {{{"left", {"box-top", "red-region"}}, {"right", {"table", "box-top"}}}, {}};
  const std::map<std::string, int> room = {{"p2", 2}, {"p3", 3}, {"p4", 4}, {"p5", 4}, {"p6", 4}};
  return {{{"left", {}}, {"right", {"table", "tray"}}}, {{"tray", room.at(problem)}}};
}

bool measure_paper(nlohmann::json& json) {
  std::printf("problem   read ms   plan ms   steps   decompositions   asked   refused\n");
  for (const std::string problem : {"d1", "d2", "p1", "p2", "p3", "p4", "p5", "p6"}) {
    const lisp::Source domain = file("two_arms"), text = file(problem);
    std::vector<double> reading, planning;
    htn::SearchStatistics statistics;
    std::size_t steps = 0;
    for (int i = 0; i < kRuns; ++i) {
      auto began = Clock::now();
      const auto read = htn::read_task(domain, text, htn::test::kGeometricPredicates);
      reading.push_back(ms_since(began));
      if (!read) return false;
      TableGeometry geometry(read->task, limits_of(problem));
      began = Clock::now();
      htn::Search search(read->task, {}, &geometry);
      const htn::SearchOutcome outcome = search.next();
      planning.push_back(ms_since(began));
      if (!outcome.plan) return false;
      steps = outcome.plan->steps.size();
      statistics = search.statistics();
    }
    std::printf("%-7s %9.3f %9.3f %7zu %16llu %7llu %9llu\n", problem.c_str(), middle(reading),
                middle(planning), steps, static_cast<unsigned long long>(statistics.decompositions),
                static_cast<unsigned long long>(statistics.external_calls),
                static_cast<unsigned long long>(statistics.refusals));
    json["htn_" + problem + "_ms"] = middle(planning);
  }
  return true;
}

struct Size {
  const char* name;
  bool ring;
  int places;  // of the square: of a side
  int packages;
};

bool measure_growth(nlohmann::json& json) {
  std::printf(
      "\ntransport                steps   decompositions   plan ms   nodes/s   SHOP2 as printed ms\n");
  for (const Size& size : {Size{"ring 20, 20", true, 20, 20}, Size{"ring 35, 35", true, 35, 35},
                           Size{"ring 100, 100", true, 100, 100}, Size{"ring 300, 300", true, 300, 300},
                           Size{"square 5x5, 5", false, 5, 5}, Size{"square 20x20, 50", false, 20, 50},
                           Size{"square 40x40, 100", false, 40, 100}}) {
    const lisp::Source domain{"transport", htn::test::transport_domain()};
    const lisp::Source text{"problem", size.ring ? htn::test::ring_problem(size.places, size.packages)
                                                 : htn::test::grid_problem(size.places, size.packages)};
    const auto read = htn::read_task(domain, text);
    if (!read) return false;
    auto began = Clock::now();
    htn::Search search(read->task);
    const htn::SearchOutcome outcome = search.next();
    const double ms = ms_since(began);
    if (!outcome.plan) return false;
    const std::size_t steps = outcome.plan->steps.size();
    const double rate = static_cast<double>(search.statistics().decompositions) / ms * 1e3;
    // What recursion by recursion comes to many steps needs more stack than a thread has.
    const bool stackable = steps < 1500;
    began = Clock::now();
    const PlainAnswer plain =
        stackable ? decompose_plainly(read->task, Clock::now() + kBaselineTime) : PlainAnswer{};
    const double plain_ms = ms_since(began);
    std::printf("%-22s %7zu %16llu %9.2f %9.0f   ", size.name, steps,
                static_cast<unsigned long long>(search.statistics().decompositions), ms, rate);
    if (plain.solved) {
      std::printf("%.2f (%.1f times ours)\n", plain_ms, plain_ms / ms);
    } else {
      std::printf(stackable ? "none in 2 s\n" : "not tried: its recursion is too deep\n");
    }
    if (std::strcmp(size.name, "ring 35, 35") == 0) {
      json["htn_decompositions_per_s"] = rate;
      json["htn_ratio_to_plain"] = plain.solved ? nlohmann::json(plain_ms / ms) : nlohmann::json();
    }
  }
  return true;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  using stepwright::result::ExitCode;
  using stepwright::result::to_int;
  const char* json_file = nullptr;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--json") == 0 && i + 1 < argc) {
      json_file = argv[++i];
    } else {
      std::fprintf(stderr, "usage: bench_htn [--json FILE]\n");
      return to_int(ExitCode::Usage);
    }
  }
  nlohmann::json json;
  if (!stepwright::bench::measure_paper(json) || !stepwright::bench::measure_growth(json)) {
    std::fprintf(stderr, "a problem was not solved\n");
    return to_int(ExitCode::RuntimeFault);
  }
  if (json_file != nullptr) std::ofstream(json_file) << json.dump(1) << "\n";
  return to_int(ExitCode::Done);
}

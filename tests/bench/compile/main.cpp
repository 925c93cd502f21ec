// Edit to run: how long 1000 rungs take from source to a verified container, with the default warnings, as ST
// and as ladder, beside g++ -O2 on the same logic in C++. Then the growth: rungs, POUs, steps, tags and more,
// each at several sizes. The time per unit must stay that of the smallest size, and so must the memory.
//
//   bench_compile [--json FILE]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ladder/driver/compile.h"
#include "runtime/ground/result/exit_code.h"
#include "tests/bench/compile/curve.h"
#include "tests/bench/compile/rungs.h"
#include "tests/support/long_sources.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRungs = 1000;

struct Times {
  double least_ms = 0;
  double median_ms = 0;
};

template <typename Run>
Times times_of(int repeats, Run run) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const auto start = Clock::now();
    run();
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  return {times.front(), times[times.size() / 2]};
}

Times compile_times(const driver::CompileInput& input, int repeats, std::size_t& bytes) {
  return times_of(repeats, [&] {
    const auto output = driver::compile(input);
    if (!output) {
      std::fprintf(stderr, "%s", result::to_string(output.error()).c_str());
      std::exit(result::to_int(result::ExitCode::RuntimeFault));
    }
    bytes = output->container.size();
  });
}

// Below zero if there is no g++.
double gcc_ms() {
  const auto folder = std::filesystem::temp_directory_path() / "stepwright_bench_compile";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "rungs.cpp") << rungs_as_cpp(kRungs);
  const std::string command =
      "g++ -O2 -c '" + (folder / "rungs.cpp").string() + "' -o '" + (folder / "rungs.o").string() + "'";
  bool failed = false;
  const double ms = times_of(3, [&] { failed = std::system(command.c_str()) != 0; }).least_ms;
  std::filesystem::remove_all(folder);
  return failed ? -1 : ms;
}

int run(const char* json_file) {
  driver::CompileInput text;
  text.texts.push_back({"rungs.st", support::many_rungs(kRungs)});
  const graphic::Project project = rungs_as_ladder(kRungs);
  driver::CompileInput ladder;
  ladder.projects = {&project};
  std::size_t bytes = 0;
  text.lint = ladder.lint = lint::Level::Default;
  const Times st = compile_times(text, 101, bytes);
  const Times drawn = compile_times(ladder, 101, bytes);
  const double baseline_ms = gcc_ms();
  std::printf("%d rungs, source to verified container (%zu bytes)\n", kRungs, bytes);
  std::printf("  ST      least %8.2f ms, median %8.2f ms\n", st.least_ms, st.median_ms);
  std::printf("  ladder  least %8.2f ms, median %8.2f ms\n", drawn.least_ms, drawn.median_ms);
  if (baseline_ms > 0)
    std::printf("  g++ -O2 least %8.2f ms (%.0f times the ST compiler)\n", baseline_ms,
                baseline_ms / st.least_ms);
  const std::vector<Point> points = measure(all_series());
  if (json_file == nullptr) return 0;
  nlohmann::json curve = nlohmann::json::array();
  for (const Point& each : points)
    curve.push_back({{"series", each.series},
                     {"count", each.count},
                     {"least_ms", each.least_ms},
                     {"median_ms", each.median_ms},
                     {"native_ms", each.native_ms},
                     {"unit_us", each.us_per_unit},
                     {"unit_ratio", each.ratio},
                     {"peak_kb", each.peak_kb}});
  std::ofstream(json_file) << nlohmann::json{{"compile_1000_rungs_ms", st.median_ms},
                                             {"compile_1000_rungs_least_ms", st.least_ms},
                                             {"compile_1000_rungs_ladder_ms", drawn.median_ms},
                                             {"gcc_1000_rungs_ms", baseline_ms},
                                             {"curve", curve}}
                                  .dump(2)
                           << "\n";
  return 0;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  const bool has_json = argc == 3 && std::strcmp(argv[1], "--json") == 0;
  if (argc != 1 && !has_json) {
    std::fprintf(stderr, "usage: bench_compile [--json FILE]\n");
    return stepwright::result::to_int(stepwright::result::ExitCode::Usage);
  }
  return stepwright::bench::run(has_json ? argv[2] : nullptr);
}

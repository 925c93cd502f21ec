// Edit to run: how long 1000 rungs take from source to a verified container, as ST and as ladder, beside
// g++ -O2 on the same logic in C++. Then 10,000 and 100,000 rungs and libraries of 250 and 500 POUs: the time
// must grow with the size and no faster.
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
#include "runtime/result/exit_code.h"
#include "tests/bench/compile/rungs.h"
#include "tests/support/pou_library.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRungs = 1000;

template <typename Run>
double median_ms(int repeats, Run run) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const auto start = Clock::now();
    run();
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  return times[static_cast<std::size_t>(repeats / 2)];
}

double compile_ms(const driver::CompileInput& input, int repeats, std::size_t& bytes) {
  return median_ms(repeats, [&] {
    const auto output = driver::compile(input);
    if (!output) {
      std::fprintf(stderr, "%s", result::to_string(output.error()).c_str());
      std::exit(result::to_int(result::ExitCode::RuntimeFault));
    }
    bytes = output->container.size();
  });
}

double text_ms(std::string text, int repeats) {
  driver::CompileInput input;
  input.texts.push_back({"source.st", std::move(text)});
  std::size_t bytes = 0;
  return compile_ms(input, repeats, bytes);
}

// Below zero if there is no g++.
double gcc_ms() {
  const auto folder = std::filesystem::temp_directory_path() / "stepwright_bench_compile";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "rungs.cpp") << rungs_as_cpp(kRungs);
  const std::string command =
      "g++ -O2 -c '" + (folder / "rungs.cpp").string() + "' -o '" + (folder / "rungs.o").string() + "'";
  bool failed = false;
  const double ms = median_ms(3, [&] { failed = std::system(command.c_str()) != 0; });
  std::filesystem::remove_all(folder);
  return failed ? -1 : ms;
}

int run(const char* json_file) {
  driver::CompileInput text;
  text.texts.push_back({"rungs.st", rungs_as_st(kRungs)});
  const graphic::Project project = rungs_as_ladder(kRungs);
  driver::CompileInput ladder;
  ladder.projects = {&project};
  std::size_t bytes = 0;
  const double st_ms = compile_ms(text, 51, bytes);
  const double ladder_ms = compile_ms(ladder, 51, bytes);
  const double baseline_ms = gcc_ms();
  std::printf("%d rungs, source to verified container (%zu bytes)\n", kRungs, bytes);
  std::printf("  ST      %8.2f ms  %9.0f rungs/s\n", st_ms, kRungs / st_ms * 1e3);
  std::printf("  ladder  %8.2f ms  %9.0f rungs/s\n", ladder_ms, kRungs / ladder_ms * 1e3);
  if (baseline_ms > 0)
    std::printf("  g++ -O2 %8.2f ms  %9.0f rungs/s  (%.0f times the ST compiler)\n", baseline_ms,
                kRungs / baseline_ms * 1e3, baseline_ms / st_ms);
  const double ten_ms = text_ms(rungs_as_st(10 * kRungs), 11);
  const double hundred_ms = text_ms(rungs_as_st(100 * kRungs), 3);
  const double half_ms = text_ms(support::pou_library(250).text, 11);
  const double library_ms = text_ms(support::pou_library(500).text, 11);
  std::printf("growth: 10,000 rungs %.1f ms, 100,000 rungs %.0f ms (%.2f times as long per rung as 1000)\n",
              ten_ms, hundred_ms, hundred_ms / 100 / st_ms);
  std::printf("library: 250 POUs %.1f ms, 500 POUs %.1f ms (%.2f times)\n", half_ms, library_ms,
              library_ms / half_ms);
  if (json_file == nullptr) return 0;
  std::ofstream(json_file) << nlohmann::json{{"compile_1000_rungs_ms", st_ms},
                                             {"compile_1000_rungs_ladder_ms", ladder_ms},
                                             {"compile_10000_rungs_ms", ten_ms},
                                             {"compile_100000_rungs_ms", hundred_ms},
                                             {"compile_250_pous_ms", half_ms},
                                             {"compile_500_pous_ms", library_ms},
                                             {"gcc_1000_rungs_ms", baseline_ms}}
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

#include "tests/bench/compile/curve.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "ladder/driver/compile.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/native/native_engine.h"
#include "tests/support/long_sources.h"
#include "tests/support/pou_library.h"

namespace stepwright::bench {

namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

driver::CompileOutput compiled(const driver::CompileInput& input) {
  auto output = driver::compile(input);
  if (output) return std::move(*output);
  std::fprintf(stderr, "%.2000s", result::to_string(output.error()).c_str());
  std::exit(result::to_int(result::ExitCode::RuntimeFault));
}

// In a process of its own, whose memory holds nothing else.
long peak_kb(const driver::CompileInput& input) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const bool sound = driver::compile(input).has_value();
    _exit(sound ? 0 : 1);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child) return 0;
  return usage.ru_maxrss;
}

double native_ms(std::vector<std::byte> container) {
  if (!native::NativeEngine::supported()) return 0;
  const auto loaded = reader::LoadedProgram::load(std::move(container), "curve");
  if (!loaded) return 0;
  const auto start = Clock::now();
  const auto engine = native::NativeEngine::compile(loaded->program());
  return engine ? ms_since(start) : 0;
}

Point measured(const Series& series, int count) {
  driver::CompileInput input;
  input.texts.push_back({"source.st", series.text(count)});
  input.lint = lint::Level::Default;
  Point point{.series = series.name, .count = count};
  point.peak_kb = peak_kb(input);
  std::vector<double> times;
  driver::CompileOutput output;
  // Small sources often, large ones three times.
  for (double spent = 0; times.size() < 3 || (times.size() < 31 && spent < 500); spent += times.back()) {
    const auto start = Clock::now();
    output = compiled(input);
    times.push_back(ms_since(start));
  }
  std::sort(times.begin(), times.end());
  point.least_ms = times.front();
  point.median_ms = times[times.size() / 2];
  point.native_ms = native_ms(std::move(output.container));
  point.us_per_unit = point.least_ms * 1000 / count;
  return point;
}

std::string pous(int count) {
  return support::pou_library(count).text;
}

}  // namespace

std::vector<Series> all_series() {
  using namespace support;
  return {
      {"rungs", many_rungs, {1'000, 10'000, 100'000}},
      {"rungs in a line", many_rungs_in_a_line, {1'000, 10'000, 30'000}},
      {"POUs", pous, {100, 250, 500, 1'000, 2'000, 5'000}},
      {"callees", many_callees, {100, 1'000, 10'000}},
      {"steps", many_steps, {100, 1'000, 5'000}},
      {"tags", many_tags, {100, 1'000, 10'000, 30'000}},
      {"members", many_fields, {100, 1'000, 10'000, 100'000}},
      {"enumerators", many_enumerators, {100, 1'000, 10'000, 100'000}},
      {"labels", many_labels, {100, 1'000, 10'000, 100'000}},
      {"branches", many_branches, {100, 1'000, 10'000, 100'000}},
      {"constants", many_constants, {100, 1'000, 10'000, 100'000}},
      {"first values", many_elements, {1'000, 10'000, 100'000}},
      {"repeated values", repeated_elements, {10'000, 1'000'000, 10'000'000}},
      {"nested IFs", nested_ifs, {10, 140}},
      {"nested blocks", doubled_blocks, {4, 8, 12}},
  };
}

std::vector<Point> measure(const std::vector<Series>& all) {
  std::printf("%-16s %9s %10s %10s %9s %9s %6s %9s\n", "series", "count", "least ms", "median ms",
              "native ms", "us each", "ratio", "peak KB");
  std::vector<Point> points;
  for (const Series& series : all) {
    double first = 0;
    for (const int count : series.counts) {
      Point point = measured(series, count);
      if (first == 0) first = point.us_per_unit;
      point.ratio = point.us_per_unit / first;
      std::printf("%-16s %9d %10.2f %10.2f %9.2f %9.3f %6.2f %9ld\n", point.series, point.count,
                  point.least_ms, point.median_ms, point.native_ms, point.us_per_unit, point.ratio,
                  point.peak_kb);
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace stepwright::bench

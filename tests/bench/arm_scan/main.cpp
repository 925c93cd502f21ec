// What a scan costs that moves two arms of seven joints along paths and watches how far they are apart, on
// both engines, beside the same interpolation in C++. Two programs: interpolation alone, and with the
// interlock.
//
//   bench_arm_scan [--json FILE]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/engine_program/engine_program.h"
#include "tests/unit/ladder/driver/path_table.h"
#include "tests/unit/ladder/driver/two_arms.h"

namespace stepwright::bench {
namespace {

using driver_test::PathTable;
using support::EngineKind;
using support::EngineProgram;
using Clock = std::chrono::steady_clock;

constexpr int kPasses = 20;
constexpr std::int64_t kCycleNs = 4'000'000;
constexpr double kAim_us = 20.0;

std::string program_text(bool watched) {
  std::string text =
      "PROGRAM main\nVAR\n  factor : LREAL := 1.0; busy : BOOL; points1, points2 : ARRAY[0..7] OF "
      "MC_WAY_POINT; rows1, rows2 : ARRAY[0..55] OF MC_TIME_ROW; path1, path2 : MC_PATH;\n"
      "  g1, g2 : AXES_GROUP; enable1, enable2 : MC_GroupEnable; slow1, slow2 : MC_GroupSetOverride; "
      "move1, move2 : MC_MovePath; run1, run2 : MC_RunAxesGroup;\n";
  if (watched) text += driver_test::kTwoArms + std::string("  started : BOOL; watch : MC_WatchDistance;\n");
  text += "END_VAR\n";
  for (const std::string n : {"1", "2"})
    text += "  g" + n + ".ActualPosition := g" + n + ".SetPosition;\n  enable" + n +
            "(Execute := TRUE, AxesGroup := g" + n + ");\n  slow" + n +
            "(Enable := TRUE, VelFactor := factor, AxesGroup := g" + n + ");\n  move" + n +
            "(Execute := TRUE, Path := path" + n + ", Points := points" + n + ", Rows := rows" + n +
            ", AxesGroup := g" + n + ");\n";
  // Limit so low that nothing stops.
  if (watched)
    text += std::string("  IF NOT started THEN\n    started := TRUE;\n") + driver_test::kRightArm +
            "  END_IF;\n"
            "  watch(MinDistance := -100.0, FirstArm := leftArm, SecondArm := rightArm, FirstGroup := g1, "
            "SecondGroup := g2);\n";
  return text +
         "  run1(AxesGroup := g1);\n  run2(AxesGroup := g2);\n  busy := move1.Busy OR "
         "move2.Busy;\nEND_PROGRAM\n";
}

class Cell {
 public:
  Cell(bool watched, EngineKind kind) : program_(support::compile_st(program_text(watched)), kind) {}

  template <typename T>
  void set(const std::string& path, T value) {
    std::memcpy(&program_.memory()[program_.variable("main." + path).address], &value, sizeof value);
  }
  void load(const std::string& n, const PathTable& table) {
    set("path" + n + ".Points", static_cast<std::int32_t>(table.points.size()));
    set("path" + n + ".Rows", static_cast<std::int32_t>(table.rows.size()));
    set("path" + n + ".Duration", table.duration_s);
    set("path" + n + ".RateSlope", table.rate_slope);
    set("path" + n + ".RateBend", table.rate_bend);
    for (std::size_t k = 0; k < table.points.size(); ++k) {
      const std::string point = "points" + n + "[" + std::to_string(k) + "].";
      set(point + "S", table.points[k].place);
      set(point + "H", table.points[k].blend);
      for (std::size_t j = 0; j < table.joints; ++j) {
        const std::string index = "[" + std::to_string(j + 1) + "]";
        set(point + "Q" + index, table.points[k].joints[j]);
        set(point + "U" + index, table.points[k].direction[j]);
        if (k == 0) set("g" + n + ".SetPosition" + index, table.points[k].joints[j]);
      }
    }
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
      const std::string row = "rows" + n + "[" + std::to_string(k) + "].";
      set(row + "T", table.rows[k].begin_s);
      set(row + "R", 1.0 / table.rows[k].length_s);
      for (std::size_t c = 0; c < 6; ++c) set(row + "C" + std::to_string(c), table.rows[k].c[c]);
    }
  }
  // Until both arms are at their ends; the times of the scans.
  void pass(std::vector<double>& times_us) {
    const std::uint32_t busy = program_.variable("main.busy").address;
    int scan = 0;
    do {
      if (scan % 200 == 100) set("factor", 0.5);
      if (scan % 200 == 199) set("factor", 1.0);
      const auto start = Clock::now();
      const bool went = program_.scan(kCycleNs * scan);
      times_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
      if (!went || ++scan > 20'000) throw std::runtime_error("the program trapped, or did not end");
    } while (program_.memory()[busy] != std::byte{0});
  }

 private:
  EngineProgram program_;
};

double part(std::vector<double>& values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Seven joints and way-points with blends.
PathTable long_table(std::uint32_t from) {
  for (std::uint32_t seed = from;; ++seed) {
    PathTable table = driver_test::random_table(seed);
    if (table.joints == 7 && table.points.size() == 6) return table;
  }
}

// Two arms' set points at as many times, in C++.
double in_cpp_us(const PathTable& first, const PathTable& second) {
  std::vector<double> times;
  double sum = 0.0;
  for (double time = 0.0; time < first.duration_s; time += 1e-9 * kCycleNs) {
    const auto start = Clock::now();
    sum += first.at(time)[0] + second.at(time)[6];
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
  return sum == sum ? part(times, 0.5) : 0.0;
}

int run(const char* json_file) {
  const PathTable first = long_table(1), second = long_table(1000);
  nlohmann::json json = {{"aim_us", kAim_us}, {"cpp_p50_us", in_cpp_us(first, second)}};
  bool reached = true;
  for (const bool watched : {false, true})
    for (const auto& [name, kind] :
         {std::pair("native", EngineKind::Native), std::pair("vm", EngineKind::Vm)}) {
      std::vector<double> times;
      for (int pass = 0; pass < kPasses; ++pass) {
        Cell cell(watched, kind);
        cell.load("1", first);
        cell.load("2", second);
        cell.pass(times);
      }
      const std::string key = std::string(watched ? "watched_" : "moved_") + name;
      json[key + "_p50_us"] = part(times, 0.5);
      json[key + "_p99_us"] = part(times, 0.99);
      if (kind == EngineKind::Native) reached = reached && part(times, 0.5) <= kAim_us;
    }
  std::puts(json.dump(2).c_str());
  if (!reached) std::puts("more than what it shall cost");
  if (json_file != nullptr) std::ofstream(json_file) << json.dump(2) << "\n";
  return 0;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  return stepwright::bench::run(argc == 3 && std::strcmp(argv[1], "--json") == 0 ? argv[2] : nullptr);
}

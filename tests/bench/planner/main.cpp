// The planner beside others: instances of many domains (generators/), a textbook planner in the same run
// (baseline/), planners found outside. Per instance: time to the first plan, cost over time, final cost
// against the best known, bound, memory. Every plan passes the validator; a wrong one of ours ends the bench.
//
//   bench_planner [--time S] [--domains A,B] [--json FILE] ...      the table
//   bench_planner --scale [--full] [--svg FOLDER] [--json FILE]      growing sizes until a limit ends them

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/ground/files/files.h"
#include "runtime/ground/result/exit_code.h"
#include "tests/bench/planner/report/curve_svg.h"
#include "tests/bench/planner/report/table.h"
#include "tests/bench/planner/scale.h"
#include "tests/bench/planner/suite.h"
#include "tests/bench/planner/tank_cell.h"

namespace stepwright::bench {
namespace {

using nlohmann::json;
using result::ExitCode;

int fail(const result::Diagnostics& problems, ExitCode code) {
  std::fprintf(stderr, "%s\n", result::to_string(problems).c_str());
  return to_int(code);
}

// A wrong plan and a text that does not parse are faults of ours, a wrong option or file is not.
ExitCode code_of(const result::Diagnostics& problems) {
  return !problems.empty() && problems.front().code == "P0001" ? ExitCode::BadInput : ExitCode::RuntimeFault;
}

int write_report(const Settings& settings, const json& report) {
  if (settings.json_file.empty()) return to_int(ExitCode::Done);
  const auto failed = files::write_file(settings.json_file, report.dump(2) + "\n");
  return failed.empty() ? to_int(ExitCode::Done) : fail(failed, ExitCode::BadInput);
}

// What takes minutes should not end at a report that nobody gets.
result::Diagnostics check_outputs(const Settings& settings) {
  result::Diagnostics problems;
  const auto check = [&](bool wanted, const std::string& file) {
    if (!wanted) return;
    for (result::Diagnostic& refused : files::check_writable(file)) problems.push_back(std::move(refused));
  };
  check(!settings.json_file.empty(), settings.json_file);
  check(settings.update_best, settings.best_file);
  return problems;
}

void print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

int run_table(const Settings& settings) {
  auto best = BestKnown::load(settings.best_file);
  if (!best) return fail(best.error(), ExitCode::BadInput);
  auto cell = measure_tank_cell(settings.repeats);
  if (!cell) return fail(cell.error(), ExitCode::BadInput);
  print("\n" + heading(settings));
  const auto rows = run_suite(settings, *best, [&](const Row& row) { print(line(settings, row)); });
  if (!rows) return fail(rows.error(), code_of(rows.error()));
  print(summary(settings, *rows));
  if (settings.update_best && !best->save(settings.best_file)) {
    std::fprintf(stderr, "cannot write %s\n", settings.best_file.c_str());
    return to_int(ExitCode::BadInput);
  }
  json report = to_json(settings, *rows);
  report.update(*cell);
  return write_report(settings, report);
}

void print_point(const std::string& domain, const ScalePoint& point) {
  const auto one = [](const Measurement& measured) {
    char text[96] = "";
    if (measured.solved()) {
      std::snprintf(text, sizeof text, "%10.1f ms %8.1f MB %6zu steps", measured.first().wall_ms,
                    measured.peak_mb, measured.first().steps);
    } else {
      std::snprintf(text, sizeof text, "%-36.36s", measured.outcome.c_str());
    }
    return std::string(text);
  };
  std::printf("%-16s %4d  %8zu operators  planner %s   baseline %s\n", domain.c_str(), point.size,
              point.ground.operators, one(point.ours).c_str(), one(point.baseline).c_str());
  std::fflush(stdout);
}

int run_curves(const Settings& settings) {
  const auto curves = run_scale(settings, print_point);
  if (!curves) return fail(curves.error(), code_of(curves.error()));
  if (!settings.svg_folder.empty()) {
    std::error_code ignored;
    std::filesystem::create_directories(settings.svg_folder, ignored);
    for (const Curve& curve : *curves) {
      std::ofstream file(settings.svg_folder + "/" + curve.domain + ".svg");
      file << to_svg(curve);
      if (!file) {
        std::fprintf(stderr, "cannot write to %s\n", settings.svg_folder.c_str());
        return to_int(ExitCode::BadInput);
      }
    }
  }
  return write_report(settings, {{"time_limit_s", static_cast<double>(settings.limits.time.count()) / 1000.0},
                                 {"memory_limit_mb", settings.limits.memory_mb},
                                 {"curves", to_json(*curves)}});
}

int run(const Settings& settings) {
  if (const auto refused = check_outputs(settings); !refused.empty())
    return fail(refused, ExitCode::BadInput);
  if (!settings.write_folder.empty()) {
    const auto instances = instances_of(settings);
    if (!instances) return fail(instances.error(), ExitCode::BadInput);
    const bool written = write_instances(settings.write_folder, *instances);
    std::printf("%zu instances in %s\n", instances->size(), settings.write_folder.c_str());
    return to_int(written ? ExitCode::Done : ExitCode::BadInput);
  }
  return settings.scale ? run_curves(settings) : run_table(settings);
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  int exit_code = 0;
  const auto settings = stepwright::bench::settings_from(argc, argv, exit_code);
  return settings ? stepwright::bench::run(*settings) : exit_code;
}

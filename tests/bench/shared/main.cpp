// bench_shared [--seconds S] [--json FILE]: steps a second of plants in processes of their own
// (step_rates.h).

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"
#include "tests/bench/shared/step_rates.h"

namespace stepwright::bench_shared {
namespace {

int run(double seconds, const std::string& json_file) {
  const StepRates rates = measure_step_rates(seconds);
  if (json_file.empty()) return result::to_int(result::ExitCode::Done);
  const nlohmann::json json = {{"baseline_turns_per_s", rates.baseline_turns_per_s},
                               {"shared_steps_per_s_c", rates.c_per_s},
                               {"shared_steps_per_s_python", rates.python_per_s},
                               {"fmu_step_us", rates.fmu2_step_us},
                               {"fmu3_step_us", rates.fmu3_step_us},
                               {"st_steps_per_s", rates.st_per_s}};
  std::ofstream file(json_file);
  file << json.dump(2) << "\n";
  return result::to_int(file ? result::ExitCode::Done : result::ExitCode::BadInput);
}

}  // namespace
}  // namespace stepwright::bench_shared

int main(int argc, char** argv) {
  CLI::App app{"Steps of plants in processes of their own", "bench_shared"};
  double seconds = 2.0;
  std::string json;
  app.add_option("--seconds", seconds, "of each measurement")->check(CLI::Range(0.1, 600.0));
  app.add_option("--json", json, "write the figures to this file");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  return stepwright::bench_shared::run(seconds, json);
}

// The stochastic campaign: simulated runs of the tank bench with random faults, demands and sensor errors, or
// of the sorting line with random faults, as fast as the machine allows. Every run must end at the goal or in
// the safe state with the right report; the undisturbed class is the baseline of costs and times beside the
// disturbed ones.
//
//   bench_campaign [--cell bench|conveyor] [--runs N] [--first SEED] [--threads N] [--json FILE]
//
// A single seed again: --first SEED --runs 1.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <thread>

#include "runtime/result/exit_code.h"
#include "tests/bench/campaign/campaign.h"
#include "tests/bench/campaign/line.h"

namespace stepwright::campaign {
namespace {

using result::ExitCode;

struct Arguments {
  std::uint64_t first = 0;
  std::uint64_t runs = 1'000;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string json_file;
  bool line = false;  // the sorting line instead of the bench
};

bool read(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i < argc; i += 2) {
    if (i + 1 >= argc) return false;
    const std::string name = argv[i];
    if (name == "--json") {
      arguments.json_file = argv[i + 1];
      continue;
    }
    if (name == "--cell") {
      arguments.line = std::strcmp(argv[i + 1], "conveyor") == 0;
      if (!arguments.line && std::strcmp(argv[i + 1], "bench") != 0) return false;
      continue;
    }
    char* end = nullptr;
    const std::uint64_t value = std::strtoull(argv[i + 1], &end, 10);
    if (*end != '\0') return false;
    if (name == "--runs") {
      arguments.runs = value;
    } else if (name == "--first") {
      arguments.first = value;
    } else if (name == "--threads") {
      arguments.threads = static_cast<unsigned>(std::max<std::uint64_t>(1, value));
    } else {
      return false;
    }
  }
  return true;
}

int finish(const Arguments& arguments, const std::string& table, const std::string& json, bool lost) {
  std::fputs(table.c_str(), stdout);
  if (!arguments.json_file.empty()) {
    std::ofstream file(arguments.json_file);
    file << json << "\n";
    if (!file) return to_int(ExitCode::BadInput);
  }
  return to_int(lost ? ExitCode::RuntimeFault : ExitCode::Done);
}

int run_lines(const Arguments& arguments) {
  const LineFigures figures = line_campaign(arguments.first, arguments.runs, arguments.threads);
  return finish(arguments, table(figures), to_json(figures, arguments.first, arguments.threads),
                !figures.lost.empty());
}

int run_bench(const Arguments& arguments) {
  const auto desk = campaign_desk();
  if (!desk) {
    std::fprintf(stderr, "%s\n", result::to_string(desk.error()).c_str());
    return to_int(ExitCode::BadInput);
  }
  const Figures figures =
      campaign(*desk, arguments.first, arguments.runs, arguments.threads, [&](std::uint64_t done) {
        std::fprintf(stderr, "\r%llu of %llu", static_cast<unsigned long long>(done),
                     static_cast<unsigned long long>(arguments.runs));
      });
  std::fprintf(stderr, "\n");
  return finish(arguments, table(figures), to_json(figures, arguments.first, arguments.threads),
                !figures.lost.empty());
}

}  // namespace
}  // namespace stepwright::campaign

int main(int argc, char** argv) {
  stepwright::campaign::Arguments arguments;
  if (!stepwright::campaign::read(argc, argv, arguments)) {
    std::fprintf(stderr,
                 "usage: bench_campaign [--cell bench|conveyor] [--runs N] [--first SEED] [--threads N] "
                 "[--json FILE]\n");
    return to_int(stepwright::result::ExitCode::Usage);
  }
  return arguments.line ? stepwright::campaign::run_lines(arguments)
                        : stepwright::campaign::run_bench(arguments);
}

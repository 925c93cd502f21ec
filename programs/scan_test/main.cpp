// `stepwright scan-test [IMAGE.swb]`: how punctual scans are on this machine, beside a bare wake-up loop.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "ladder/driver/compile.h"
#include "programs/scan_test/report.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/scan_test/measurement.h"
#include "runtime/scan_test/rung_source.h"
#include "runtime/scan_test/scan_test_svg.h"

namespace stepwright::scan_test {
namespace {

using result::ExitCode;

struct Arguments {
  std::string image;
  std::int64_t interval_us = 1'000;
  std::uint32_t rungs = 1'000;
  std::string load;
  std::string engine = "auto";
  std::string json_file;
  std::string svg_file;
  MeasureOptions options;
};

result::Result<std::vector<std::byte>> program_of(const Arguments& arguments) {
  if (arguments.image.empty()) {
    driver::CompileInput input;
    input.texts.push_back({"scan_test.st", rung_source(arguments.rungs, arguments.interval_us)});
    auto output = driver::compile(input);
    if (!output) return result::forward(output);
    return std::move(output->container);
  }
  auto text = files::read_file(arguments.image);
  if (!text) return result::forward(text);
  const auto bytes = std::as_bytes(std::span(*text));
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

// On a terminal only, and wiped at the end.
void show_progress(double done, double seconds) {
  if (isatty(STDERR_FILENO) == 0) return;
  if (done < 1.0) {
    std::fprintf(stderr, "\rmeasuring: %3.0f %% of %g s ", done * 100.0, seconds);
  } else {
    std::fprintf(stderr, "\r%40s\r", "");
  }
}

int run(Arguments arguments) {
  auto load = LoadKinds::parse(arguments.load);
  if (!load) return process::fail(load.error(), ExitCode::Usage);
  arguments.options.load = *load;
  arguments.options.engine = arguments.engine == "native" ? host::EngineKind::Native
                             : arguments.engine == "vm"   ? host::EngineKind::Vm
                                                          : host::EngineKind::Auto;
  const auto container = program_of(arguments);
  if (!container) return process::fail(container.error(), ExitCode::BadInput);
  const double seconds = arguments.options.seconds;
  const auto measured =
      measure(*container, arguments.options, [seconds](double done) { show_progress(done, seconds); });
  if (!measured) return process::fail(measured.error(), ExitCode::BadInput);
  std::fputs(to_text(*measured).c_str(), stdout);
  const std::pair<const std::string&, std::string> files[] = {
      {arguments.json_file, to_json(*measured).dump(2) + "\n"}, {arguments.svg_file, to_svg(*measured)}};
  for (const auto& [file, text] : files) {
    if (file.empty()) continue;
    const result::Diagnostics problems = files::write_file(file, text);
    if (result::has_errors(problems)) return process::fail(problems, ExitCode::BadInput);
  }
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::scan_test

int main(int argc, char** argv) {
  using namespace stepwright::scan_test;
  CLI::App app{"Scan timing beside a bare wake-up loop", "stepwright scan-test"};
  Arguments arguments;
  app.add_option("image", arguments.image, "program to scan (default: rungs made for this test)");
  app.add_option("--interval", arguments.interval_us, "of the default program, in us")
      ->check(CLI::Range(100, 1'000'000))
      ->capture_default_str();
  app.add_option("--rungs", arguments.rungs, "of the default program")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  app.add_option("--seconds", arguments.options.seconds, "how long")
      ->check(CLI::Validator(stepwright::process::refuse_seconds, "SECONDS"))
      ->check(CLI::Range(0.1, 86'400.0))
      ->capture_default_str();
  app.add_option("--load", arguments.load, "what keeps the machine busy: cpu,disk,net");
  app.add_option("--cpu", arguments.options.cpu, "the processor on which both loops run (default: any)")
      ->check(CLI::Range(0, 1'023));
  app.add_option("--engine", arguments.engine, "auto, native or vm")
      ->check(CLI::IsMember({"auto", "native", "vm"}));
  app.add_option("--json", arguments.json_file, "file for the report");
  app.add_option("--svg", arguments.svg_file, "file for the picture");
  app.footer("Exit codes: 0 measured, 1 the program cannot be measured (stderr says why), 2 usage.");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  return run(std::move(arguments));
}

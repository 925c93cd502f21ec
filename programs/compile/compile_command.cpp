#include "programs/compile/compile_command.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <deque>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "ladder/driver/compile.h"
#include "ladder/exchange/plcopen_reader.h"
#include "ladder/source/render.h"
#include "programs/process/command_line.h"
#include "programs/process/diagnostics_json.h"
#include "programs/process/files.h"
#include "runtime/result/exit_code.h"

namespace stepwright::compile_program {

namespace {

using result::ExitCode;

struct Arguments {
  std::vector<std::string> sources;
  std::string image;
  std::string json_file;
};

ExitCode compile(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  driver::CompileInput input;
  std::vector<source::NamedText> files;  // as they were written, for the lines of diagnostics
  std::deque<graphic::Project> projects;
  result::Diagnostics diagnostics;
  const auto fail = [&](const result::Diagnostics& errors) {
    diagnostics.insert(diagnostics.end(), errors.begin(), errors.end());
  };
  for (const std::string& path : arguments.sources) {
    auto text = process::read_file(path);
    if (!text) {
      fail(text.error());
      continue;
    }
    files.push_back({path, *text});
    if (!process::is_xml(path)) {
      input.texts.push_back({path, std::move(*text)});
      continue;
    }
    auto project = exchange::read_plcopen(path, std::move(*text));
    if (project) {
      input.projects.push_back(&projects.emplace_back(std::move(*project)));
    } else {
      fail(project.error());
    }
  }
  std::size_t bytes = 0;
  if (diagnostics.empty()) {
    const auto output = driver::compile(input);
    diagnostics = output ? output->warnings : output.error();
    if (output) {
      bytes = output->container.size();
      fail(process::write_file(arguments.image,
                               {reinterpret_cast<const char*>(output->container.data()), bytes}));
    }
  }
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  for (const result::Diagnostic& each : diagnostics) std::cerr << source::render(each, files);
  const bool failed = result::has_errors(diagnostics);
  if (!arguments.json_file.empty()) {
    const nlohmann::json report = {{"diagnostics", process::diagnostics_json(diagnostics)},
                                   {"bytes", failed ? 0 : bytes},
                                   {"wall_ms", wall.count()}};
    const std::string text = report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    const result::Diagnostics unwritten = process::write_file(arguments.json_file, text);
    for (const result::Diagnostic& each : unwritten) std::cerr << source::render(each, files);
    if (!unwritten.empty()) return ExitCode::BadInput;
  }
  return failed ? ExitCode::BadInput : ExitCode::Done;
}

}  // namespace

int run_compile(int argc, char** argv) {
  CLI::App app("Compiles IEC 61131-3 sources to a bytecode image", "stepwright compile");
  Arguments arguments;
  app.add_option("sources", arguments.sources, "ST files (.st) and PLCopen projects (.xml)")->required();
  app.add_option("-o,--output", arguments.image, "image file to write (.swb)")->required();
  app.add_option("--json", arguments.json_file, "file for the report");
  if (const auto exit = process::parse(app, argc, argv)) return *exit;
  return result::to_int(compile(arguments));
}

}  // namespace stepwright::compile_program

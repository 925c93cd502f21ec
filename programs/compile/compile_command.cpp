#include "programs/compile/compile_command.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cell/monitors/cell_monitors.h"
#include "ladder/source_files/source_files.h"
#include "runtime/bytecode/reader/container_file.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/diagnostics_json.h"

namespace stepwright::compile_program {

namespace {

using result::ExitCode;
using result::Severity;

// What -W asks for; the last level counts.
struct WarningOptions {
  lint::Level level = lint::Level::Default;
  bool are_errors = false;
};

WarningOptions warning_options(const std::vector<std::string>& values) {
  WarningOptions options;
  for (const std::string& each : values) {
    if (each == "error") {
      options.are_errors = true;
    } else {
      options.level = each == "none"  ? lint::Level::None
                      : each == "all" ? lint::Level::All
                                      : lint::Level::Default;
    }
  }
  return options;
}

void apply(const WarningOptions& options, result::Diagnostics& diagnostics) {
  if (options.level == lint::Level::None)
    std::erase_if(diagnostics, [](const auto& each) { return each.severity == Severity::Warning; });
  if (!options.are_errors) return;
  for (result::Diagnostic& each : diagnostics)
    if (each.severity == Severity::Warning) each.severity = Severity::Error;
}

// The monitors of a cell, by its file.
result::Result<std::vector<driver::Watcher>> watchers_of(const std::string& cell) {
  const auto config = config::load_cell_config(cell);
  if (!config) return tl::unexpected(config.error());
  const auto monitors = cell_monitors::cell_monitors(*config);
  if (!monitors) return tl::unexpected(monitors.error());
  return cell_monitors::watchers_of(*monitors);
}

std::vector<std::byte> compile(const CompileArguments& arguments, sources::SourceFiles& files,
                               result::Diagnostics& diagnostics) {
  files = sources::load(arguments.sources, diagnostics, arguments.options);
  if (!diagnostics.empty()) return {};
  const WarningOptions options = warning_options(arguments.warnings);
  std::vector<driver::Watcher> watchers;
  if (!arguments.cell.empty()) {
    auto made = watchers_of(arguments.cell);
    if (!made) {
      diagnostics = std::move(made.error());
      return {};
    }
    watchers = *std::move(made);
  }
  driver::CompileInput input = files.input();
  input.watchers = watchers;
  input.lint = options.level;
  input.library = arguments.check;
  input.document = !arguments.bare && !input.library;
  auto output = driver::compile(input);
  diagnostics = output ? std::move(output->warnings) : std::move(output.error());
  apply(options, diagnostics);
  if (!output || result::has_errors(diagnostics)) return {};
  return std::move(output->container);
}

// An image replaces an image only: "-o" before a wrong word costs nobody a file.
result::Diagnostics check_image(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) || files::is_stream(path)) return {};
  if (reader::is_container_or_empty(path)) return {};
  return result::fail("E0004", {path, 0, 0}, "the file is no compiled program: it is not replaced",
                      "name another file, or remove this one")
      .value();
}

}  // namespace

ExitCode run_compile(const CompileArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  result::Diagnostics diagnostics;
  sources::SourceFiles files;
  std::vector<std::byte> image;
  if (!arguments.check) diagnostics = check_image(arguments.image);
  if (diagnostics.empty()) image = compile(arguments, files, diagnostics);
  const auto append = [&](const result::Diagnostics& more) {
    diagnostics.insert(diagnostics.end(), more.begin(), more.end());
  };
  if (!image.empty() && !arguments.check)
    append(files::write_file(arguments.image, {reinterpret_cast<const char*>(image.data()), image.size()}));
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
  const bool failed = result::has_errors(diagnostics);
  if (!arguments.json_file.empty()) {
    const nlohmann::json report = {{"diagnostics", process::diagnostics_json(diagnostics)},
                                   {"bytes", failed ? 0 : image.size()},
                                   {"wall_ms", wall.count()}};
    append(files::write_file(arguments.json_file,
                             report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"));
  }
  sources::print(diagnostics, files.files);
  return result::has_errors(diagnostics) ? ExitCode::BadInput : ExitCode::Done;
}

}  // namespace stepwright::compile_program

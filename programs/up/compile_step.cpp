#include "programs/up/compile_step.h"

#include <chrono>

#include "runtime/ground/process/files.h"

namespace stepwright::up {

process::ChildOptions compile_command(const config::CellConfig& config, const std::filesystem::path& programs,
                                      const std::filesystem::path& image) {
  process::ChildOptions options;
  options.arguments = {(programs / "stepwright-compile").string(), "compile"};
  for (const std::filesystem::path& source : config.boot.sources)
    options.arguments.push_back(source.string());
  options.arguments.insert(options.arguments.end(), {"-o", image.string(), "--dialect", config.boot.dialect});
  if (!config.monitors.empty())
    options.arguments.insert(options.arguments.end(), {"--config", config.file.string()});
  return options;
}

process::ChildOptions change_command(const config::CellConfig& config,
                                     const std::vector<std::string>& overrides,
                                     const std::filesystem::path& programs,
                                     const std::filesystem::path& image) {
  process::ChildOptions options;
  options.arguments = {(programs / "stepwright-download").string(),
                       "download",
                       "--config",
                       config.file.string(),
                       image.string(),
                       "--change"};
  for (const std::string& each : overrides)
    options.arguments.insert(options.arguments.end(), {"--set", each});
  return options;
}

std::filesystem::path fresh_image(const config::CellConfig& config) {
  return config.boot.program.string() + ".part";
}

namespace {

// What was made of the sources, in place of what was made of them before. Sources that say something else win
// over a program that was downloaded since.
void take_in(const config::CellConfig& config) {
  const std::filesystem::path made = fresh_image(config);
  const auto now = process::read_file(made.string());
  const auto before = process::read_file(config.boot.program.string());
  std::error_code ignored;  // then the runtime says what it misses
  if (now && before && *now == *before) {
    std::filesystem::remove(made, ignored);
    return;
  }
  std::filesystem::rename(made, config.boot.program, ignored);
  if (!config.boot.keep.empty()) std::filesystem::remove(config.boot.keep, ignored);
}

}  // namespace

result::Result<result::ExitCode> compile(const config::CellConfig& config,
                                         const std::filesystem::path& programs,
                                         const process::StopSignal& stop) {
  if (config.boot.sources.empty()) return result::ExitCode::Done;
  auto child = process::ChildProcess::start(compile_command(config, programs, fresh_image(config)));
  if (!child) return result::forward(child);
  constexpr std::chrono::milliseconds kSoon{5};
  while (!child->poll())
    if (stop.wait_for(kSoon)) child->end(std::chrono::seconds(1));
  const process::ExitStatus exit = *child->poll();
  if (!exit.killed && exit.code == 0) take_in(config);
  return exit.killed ? result::ExitCode::RuntimeFault : static_cast<result::ExitCode>(exit.code);
}

}  // namespace stepwright::up

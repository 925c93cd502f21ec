#include "programs/up/compile_step.h"

#include <chrono>

#include "runtime/ground/files/files.h"

namespace stepwright::up {

process::ChildOptions compile_command(const config::CellConfig& config, const std::filesystem::path& programs,
                                      const MemoryFile& image) {
  process::ChildOptions options;
  options.descriptors = {image.descriptor()};
  options.arguments = {(programs / "stepwright-compile").string(), "compile"};
  for (const std::filesystem::path& source : config.boot.sources)
    options.arguments.push_back(source.string());
  options.arguments.insert(options.arguments.end(),
                           {"-o", MemoryFile::kInChild, "--dialect", config.boot.dialect});
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
                       "--bring-in"};
  for (const std::string& each : overrides)
    options.arguments.insert(options.arguments.end(), {"--set", each});
  return options;
}

std::filesystem::path fresh_image(const config::CellConfig& config) {
  return config.boot.program.string() + ".part";
}

result::Diagnostics keep_program(const std::filesystem::path& file, const std::string& bytes) {
  result::Diagnostics unwritten = files::write_file(file.string(), bytes);
  for (result::Diagnostic& each : unwritten)
    each.message = "the sources compile, and their program cannot be kept: " + each.message;
  return unwritten;
}

namespace {

// What was made of the sources, in place of what was made of them before; a disk that is full is in nobody's
// way where that is the same. Sources that say something else win over a program that was downloaded since.
result::Diagnostics take_in(const config::CellConfig& config, const std::string& made) {
  const auto before = files::read_file(config.boot.program.string());
  if (before && made == *before) return {};
  result::Diagnostics unwritten = keep_program(config.boot.program, made);
  std::error_code ignored;  // then the runtime says what it misses
  if (unwritten.empty() && !config.boot.keep.empty()) std::filesystem::remove(config.boot.keep, ignored);
  return unwritten;
}

}  // namespace

result::Result<result::ExitCode> compile(const config::CellConfig& config,
                                         const std::filesystem::path& programs,
                                         const process::StopSignal& stop) {
  if (config.boot.sources.empty()) return result::ExitCode::Done;
  auto image = MemoryFile::make();
  if (!image) return result::forward(image);
  auto child = process::ChildProcess::start(compile_command(config, programs, *image));
  if (!child) return result::forward(child);
  constexpr std::chrono::milliseconds kSoon{5};
  while (!child->poll())
    if (stop.wait_for(kSoon)) child->end(std::chrono::seconds(1));
  const process::ExitStatus exit = *child->poll();
  if (!exit.killed && exit.code == 0) {
    if (auto unwritten = take_in(config, image->bytes()); !unwritten.empty())
      return tl::unexpected(std::move(unwritten));
  }
  return exit.killed ? result::ExitCode::RuntimeFault : static_cast<result::ExitCode>(exit.code);
}

}  // namespace stepwright::up

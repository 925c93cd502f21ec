// `stepwright registers [IMAGE.swb] [--config CELL.toml] [--format markdown|csv|json] [-o FILE]`: at which
// Modbus addresses the variables of a program are. Of an image, or of the program that the cell's runtime
// has; with the map of the cell's configuration, or the default one.

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cell/config/cell_config.h"
#include "cell/tags/register_table.h"
#include "cell/tags/tag_notes.h"
#include "runtime/bytecode/reader/document_text.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/exit_code.h"
#include "runtime/modbus/map/build_map.h"
#include "runtime/service/connection.h"

namespace stepwright::registers {
namespace {

using result::ExitCode;

constexpr std::chrono::seconds kPatience{5};

struct Options {
  std::string image;
  std::string config;
  std::vector<std::string> overrides;
  std::string format = "markdown";
  std::string out;
};

result::Result<std::vector<std::byte>> program_of_runtime(const config::CellConfig& config) {
  auto connection = service::Connection::open(config.socket_path(), {.name = "registers"});
  if (!connection) return result::forward(connection);
  std::vector<std::byte> container;
  while (true) {
    auto reply = (*connection)->call(service::ReadProgram{container.size()}, kPatience);
    if (!reply) return result::forward(reply);
    container.insert(container.end(), reply->data.begin(), reply->data.end());
    if (container.size() >= reply->total_bytes || reply->data.empty()) return container;
  }
}

result::Result<std::vector<std::byte>> program_of(const Options& options, const config::CellConfig& config) {
  if (options.image.empty()) return program_of_runtime(config);
  auto text = files::read_file(options.image);
  if (!text) return result::forward(text);
  const auto bytes = std::as_bytes(std::span(*text));
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

int run(const Options& options) {
  config::CellConfig config;
  if (!options.config.empty()) {
    auto loaded = config::load_cell_config(options.config, options.overrides);
    if (!loaded) return process::fail(loaded.error(), ExitCode::BadInput);
    config = std::move(*loaded);
  }
  auto container = program_of(options, config);
  if (!container) return process::fail(container.error(), ExitCode::BadInput);
  auto info = reader::ProgramInfo::read(*container);
  if (!info) return process::fail(info.error(), ExitCode::BadInput);
  const auto& wanted = config.modbus_server.map;
  const auto built = modbus::map::build_map(*info, wanted);
  if (!built.problems.empty()) return process::fail(built.problems, ExitCode::BadInput);
  const tags::KnownTags known(tags::tag_notes(config.tags),
                              {info->instances(), reader::document_text(*container)});
  const auto rows = tags::tagged(modbus::map::register_rows(*info, built.map), known);
  const std::string title = "Modbus registers of " + (options.image.empty() ? config.name : options.image);
  const std::string text = options.format == "csv"    ? tags::to_csv(rows)
                           : options.format == "json" ? tags::to_json(rows)
                                                      : tags::to_markdown(rows, title, wanted.openplc);
  if (options.out.empty()) {
    std::fputs(text.c_str(), stdout);
  } else if (const auto failed = files::write_file(options.out, text); !failed.empty()) {
    return process::fail(failed, ExitCode::BadInput);
  }
  return to_int(ExitCode::Done);
}

}  // namespace
}  // namespace stepwright::registers

int main(int argc, char** argv) {
  CLI::App app{"List the Modbus addresses of a program's variables", "stepwright registers"};
  stepwright::registers::Options options;
  app.add_option("image", options.image, "compiled program (default: the one that the cell's runtime has)");
  app.add_option("--config", options.config, "cell whose [modbus.server] has the map (default: OpenPLC's)");
  app.add_option("--set", options.overrides, "KEY=VALUE that wins over the file");
  app.add_option("--format", options.format, "markdown, csv or json")
      ->check(CLI::IsMember({"markdown", "csv", "json"}));
  app.add_option("-o,--out", options.out, "write to this file instead of standard output");
  if (const auto exit = stepwright::process::parse(app, argc, argv)) return *exit;
  if (options.image.empty() && options.config.empty()) {
    std::fputs("stepwright registers: an image or --config is needed\n", stderr);
    return to_int(stepwright::result::ExitCode::Usage);
  }
  return stepwright::registers::run(options);
}

#include "cell/check/check_program.h"

#include <span>
#include <utility>

#include "cell/check/check_described_tags.h"
#include "cell/check/check_fit.h"
#include "cell/check/check_names.h"
#include "cell/check/check_tags.h"
#include "cell/check/check_wires.h"
#include "cell/monitor_check/missing_monitors.h"
#include "cell/runtime/boot_program.h"
#include "cell/runtime/host_options.h"
#include "hmi_web/server/array_selection.h"
#include "runtime/bytecode/reader/loaded_program.h"
#include "runtime/bytecode/reader/program_info.h"
#include "runtime/ground/files/files.h"
#include "runtime/host/engine_choice.h"
#include "runtime/host/program_fit.h"
#include "runtime/modbus/map/build_map.h"
#include "runtime/remote/remote_program.h"

namespace stepwright::check {

void add(result::Diagnostics& problems, const result::Diagnostics& found) {
  problems.insert(problems.end(), found.begin(), found.end());
}

namespace {

// As a load finds it; said about this program instead of "download".
template <typename Value>
void note(const result::Result<Value>& tried, const std::string& name, result::Diagnostics& problems) {
  if (tried) return;
  for (result::Diagnostic each : tried.error()) {
    if (each.where.file.empty() || each.where.file == "download") each.where.file = name;
    problems.push_back(std::move(each));
  }
}

}  // namespace

result::Result<std::optional<CellProgram>> find_program(const config::CellConfig& config,
                                                        const std::filesystem::path& image) {
  if (!image.empty()) {
    auto text = files::read_file(image.string());
    if (!text) return result::forward(text);
    const auto bytes = std::as_bytes(std::span(*text));
    return CellProgram{image.string(), {bytes.begin(), bytes.end()}};
  }
  auto found = cell_runtime::find_boot_program(config.boot);
  if (!found) return result::forward(found);
  if (!*found) return std::nullopt;
  return CellProgram{(*found)->file.string(), std::move((*found)->container)};
}

namespace {

// Tables are no news; blocks that a screen cannot show are.
result::Diagnostics left_out_blocks(const reader::ProgramInfo& info, const std::string& program) {
  result::Diagnostics problems;
  for (const auto& array : server::ArraySelection(info.tags(), info.instances()).left_out()) {
    if (!array.of_blocks) continue;
    problems.push_back({"C0636",
                        result::Severity::Warning,
                        {program},
                        "the page shows nothing of the array '" + array.name + "', which has " +
                            std::to_string(array.values) + " single values",
                        "it is told of " + std::to_string(server::kMostArrayValues) +
                            " of all arrays; divide the program between several cells"});
  }
  return problems;
}

}  // namespace

result::Diagnostics check_program(const config::CellConfig& config, const CellProgram& program) {
  result::Diagnostics problems;
  auto loaded = reader::LoadedProgram::load(program.container, program.name);
  if (!loaded) return loaded.error();
  const auto info = reader::ProgramInfo::read(program.container);
  if (!info) return info.error();
  const config::ImageConfig& image = config.image;
  if (config.controller.remote()) {
    const auto remote = remote::RemoteProgram::create(program.container, {});
    note(remote, program.name, problems);
    if (remote) note((*remote)->check_fit(image.input_bytes, image.output_bytes), program.name, problems);
  } else {
    note(host::check_fit(loaded->program(), {image.input_bytes, image.output_bytes}, program.name),
         program.name, problems);
    if (const auto options = cell_runtime::host_options(config))
      note(host::make_engine(options->engine, loaded->program()), program.name, problems);
  }
  if (config.modbus_server.enabled)
    add(problems, modbus::map::build_map(*info, config.modbus_server.map).problems);
  add(problems, check_tags(config.modbus_client, *info));
  add(problems, check_wires(config, *info));
  add(problems, check_described_tags(config.tags, *info, picture_points(config)));
  add(problems, cell_monitors::missing_monitors(config, *info));
  add(problems, check_names(config, *info));
  add(problems, check_fit(config, *info));
  add(problems, left_out_blocks(*info, program.name));
  return problems;
}

}  // namespace stepwright::check

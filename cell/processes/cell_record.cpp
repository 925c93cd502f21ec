#include "cell/processes/cell_record.h"

#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>

#include "runtime/ground/files/files.h"

namespace stepwright::processes {

std::string left_behind_by(std::string_view process) {
  if (process == "modbus-client")
    return "the outputs of the devices may still be on: only a watchdog of the device itself turns them off";
  if (process == "gateway") return "the controller may still run its program";
  return "";
}

std::filesystem::path record_path(const config::CellConfig& config) {
  return config.state_dir / "up.json";
}

std::string whole_path(const std::filesystem::path& file) {
  std::error_code error;
  const auto whole = std::filesystem::absolute(file, error);
  return (error ? file : whole).lexically_normal().string();
}

namespace {

// Its folder was moved, with the state in it.
bool was_moved(const CellRecord& record, const config::CellConfig& config) {
  std::error_code error;
  if (std::filesystem::exists(record.config, error) || error) return false;
  const auto folder = std::filesystem::canonical(config.file, error).parent_path();
  const auto state = std::filesystem::canonical(config.state_dir, error);
  return !error && std::ranges::mismatch(folder, state).in1 == folder.end();
}

}  // namespace

result::Result<void> check_same_cell(const CellRecord& record, const config::CellConfig& config) {
  const std::string file = whole_path(config.file);
  std::error_code error;
  if (record.config == file || std::filesystem::equivalent(record.config, file, error)) return {};
  if (was_moved(record, config)) return {};
  return result::fail(kOfAnotherCell, {config.file.string(), 0, 0},
                      "the state folder " + config.state_dir.string() +
                          " is that of another cell, which is up: '" + record.cell + "', " + record.config,
                      "one of the two has to have a state folder of its own: [cell] state_dir = \"state\"; " +
                          file + " is not up, and nothing was done");
}

result::Result<void> check_state_folder(const config::CellConfig& config) {
  const auto record = read_record(record_path(config));
  if (!record || (kill(record->pid, 0) != 0 && errno == ESRCH)) return {};
  return check_same_cell(*record, config);
}

std::string to_json(const CellRecord& record) {
  nlohmann::ordered_json json = {{"cell", record.cell},   {"config", record.config},
                                 {"pid", record.pid},     {"address", record.address},
                                 {"ready", record.ready}, {"processes", nlohmann::ordered_json::array()}};
  for (const ProcessRecord& each : record.processes)
    json["processes"].push_back({{"name", each.name},
                                 {"pid", each.pid},
                                 {"phase", each.phase},
                                 {"restarts", each.restarts},
                                 {"reason", each.reason}});
  if (record.program) {
    json["program"] = {
        {"state", record.program->state}, {"mode", record.program->mode}, {"detail", record.program->detail}};
  }
  json["clock"] = record.clock;
  json["killed"] = record.killed;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

result::Diagnostics write_record(const std::filesystem::path& file, const CellRecord& record) {
  return files::write_file(file.string(), to_json(record));
}

result::Result<CellRecord> read_record(const std::filesystem::path& file) {
  const auto text = files::read_file(file.string());
  if (!text) return tl::unexpected(text.error());
  CellRecord record;
  try {
    const auto json = nlohmann::json::parse(*text);
    json.at("cell").get_to(record.cell);
    json.at("config").get_to(record.config);
    json.at("pid").get_to(record.pid);
    json.at("address").get_to(record.address);
    json.at("ready").get_to(record.ready);
    for (const auto& each : json.at("processes"))
      record.processes.push_back(
          {each.at("name"), each.at("pid"), each.at("phase"), each.at("restarts"), each.at("reason")});
    record.clock = json.value("clock", std::string());
    json.at("killed").get_to(record.killed);
  } catch (const nlohmann::json::exception& error) {
    return result::fail("M0015", {file.string(), 0, 0},
                        std::string("this is no record of a cell that is up: ") + error.what(),
                        "stepwright up writes it; remove it if no process of the cell runs");
  }
  return record;
}

}  // namespace stepwright::processes

#include "cell/config/cell_config.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <span>

#include "cell/config/cell_keys.h"
#include "cell/config/place.h"
#include "cell/config/state_dir.h"
#include "cell/config/tag_table.h"
#include "cell/config/written_files.h"
#include "runtime/base/hash64.h"
#include "runtime/ground/process/temporary_folder.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {
namespace {

using settings::TomlTable;

constexpr std::size_t kMaxNameBytes = 64;         // as runtime/host/limits.h
constexpr std::size_t kMaxSocketPathBytes = 108;  // of a Unix socket's address, with its end

void read_clock(const TomlTable& table, ClockConfig& clock) {
  const std::string mode = table.choice("mode", "simulated", {"simulated", "real"});
  clock.mode = mode == "real" ? ClockMode::Real : ClockMode::Simulated;
  clock.speed = table.number("speed", clock.speed, {0.0, 1e6});
  clock.interval_us = table.integer("interval_us", clock.interval_us, {100, 10'000'000});
}

EngineKind read_engine(const TomlTable& table) {
  const std::string engine = table.choice("engine", "auto", {"auto", "native", "vm"});
  return engine == "native" ? EngineKind::Native : engine == "vm" ? EngineKind::Vm : EngineKind::Auto;
}

void read_plant(const TomlTable& table, const std::filesystem::path& folder, const ClockConfig& clock,
                PlantConfig& plant) {
  // A plant that nobody describes is none; one that is misspelt has no ports that could be wrong.
  const std::string otherwise = table.has("kind") || !plant.described ? "none" : plant.kind;
  plant.kind = table.choice("kind", otherwise,
                            {"tank_bench", "sorting_line", "fleet", "tugger", "robot_cell", "model", "shared",
                             "fmu", "st", "none"});
  plant.seed = static_cast<std::uint64_t>(table.integer("seed", 1, {0, 1e15}));
  plant.uncertainty = table.boolean("uncertainty", plant.uncertainty);
  plant.diverters = static_cast<std::size_t>(table.integer("diverters", 2, {1, 4}));
  plant.boxes = static_cast<std::size_t>(table.integer("boxes", 5, {1, 9}));
  if (plant.kind == "model") {
    plant.file = read_plant_file(table, "file", folder);
    plant.file_where = table.where("file");
    if (!table.has("file"))
      table.report("kind", "a model without its file", "file = \"plant.toml\", with its components");
  }
  if (plant.kind == "fleet") plant.fleet = read_fleet_plant(table, folder);
  if (plant.kind == "tugger") plant.tugger = read_tugger_plant(table, folder);
  if (plant.kind == "robot_cell") plant.robot_cell = read_robot_cell_plant(table, folder);
  if (is_stepped(plant.kind)) {
    plant.stepped = read_stepped_plant(table, plant.kind, folder, clock.interval_us);
    for (const auto* terminals : {&plant.stepped.actuators, &plant.stepped.sensors}) {
      for (const SteppedTerminalConfig& each : *terminals)
        plant.ports.push_back({each.name, each.address, each.where});
    }
    return;
  }
  const TomlTable ports = table.table("ports");
  for (const std::string& port : ports.keys())
    plant.ports.push_back({port, ports.text(port, {}), ports.where(port)});
}

void read_safe_state(const TomlTable& table, CellConfig& config) {
  const std::string policy = table.choice("on_lost_supervisor", "continue", {"continue", "safe"});
  config.on_lost_supervisor = policy == "safe" ? LostSupervisorPolicy::Safe : LostSupervisorPolicy::Continue;
  config.supervisor_lost_after =
      std::chrono::milliseconds(table.integer("supervisor_lost_after_ms", 1'000, {100, 600'000}));
}

void read_addresses(const TomlTable& table, DdsConfig& dds) {
  if (table.has("interfaces")) dds.interfaces = table.texts("interfaces");
  dds.peers = table.texts("peers");
  const auto check = [&](const char* key, const std::vector<std::string>& addresses) {
    for (const std::string& address : addresses) {
      in_addr parsed{};
      if (inet_pton(AF_INET, address.c_str(), &parsed) == 1) continue;
      table.report(key, "'" + address + "' is no IPv4 address", "for example 127.0.0.1", "0466");
    }
  };
  check("interfaces", dds.interfaces);
  check("peers", dds.peers);
  if (dds.interfaces.empty()) {
    table.report("interfaces", "an empty list leaves Fast DDS no way to others",
                 "[\"127.0.0.1\"] is this machine only", "0466");
  }
}

// What names a runtime on Fast DDS, where '*' and '?' would be a pattern, and what names a folder.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name.size() <= kMaxNameBytes &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
         });
}

void check_names(const TomlTable& cell, const TomlTable& dds, const CellConfig& config) {
  const char* const hint = "1 to 64 letters, digits, '_', '-' and '.'";
  if (!is_plain_name(config.name)) {
    cell.report("name", "'" + config.name + "' cannot name a cell", hint, "0461");
  } else if (!is_plain_name(config.dds.runtime_id)) {
    dds.report("runtime_id", "'" + config.dds.runtime_id + "' cannot name a runtime", hint, "0461");
  }
  const std::filesystem::path socket =
      config.safety.io.modbus ? config.modbus_client_path() : config.socket_path();
  if (socket.native().size() < kMaxSocketPathBytes) return;
  cell.report("state_dir",
              "the path of the socket " + socket.string() + " is longer than " +
                  std::to_string(kMaxSocketPathBytes - 1) + " bytes",
              "choose a shorter state_dir", "0462");
}

// A demand that no planner takes would never change.
ScheduledFault read_fault(const TomlTable& table, const missions::CellMission& mission) {
  ScheduledFault fault{table.required_number("at_s", {0.0, 1e9}), table.required_text("name"),
                       table.required_number("value"), table.where("name")};
  if (!is_goal_change(fault) || (mission.table && mission.table->takes_demands())) return fault;
  table.report(
      "name",
      mission.table ? "the planner of [" + mission.name + "] has no demand '" + fault.name + "'"
                    : "the cell has no planner that the demand '" + fault.name + "' could change for",
      "a changed demand is of a cell with [planning]; faults of a plant have no parentheses", "0449");
  return fault;
}

CellReading unread(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                   result::Diagnostics problems) {
  CellReading reading;
  reading.config.file = file;
  reading.config.overrides = overrides;
  reading.problems = std::move(problems);
  return reading;
}

}  // namespace

std::filesystem::path temporary_folder() {
  return process::temporary_place();
}

bool is_goal_change(const ScheduledFault& fault) {
  return fault.name.starts_with('(');
}

std::filesystem::path CellConfig::socket_path() const {
  return state_dir / "runtime.sock";
}

// Not on a disk: pages of a file are written back now and then, and a scan that changes one meanwhile waits.
std::filesystem::path CellConfig::plant_memory_path() const {
  const std::filesystem::path memory = "/dev/shm";
  std::error_code error;
  if (!std::filesystem::is_directory(memory, error)) return state_dir / "plant.state";
  auto whole = std::filesystem::weakly_canonical(state_dir, error);
  const std::string folder = error ? state_dir.string() : whole.string();
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx",
                static_cast<unsigned long long>(base::hash_bytes(std::as_bytes(std::span(folder)))));
  return memory / ("stepwright-plant-" + std::string(digits.data()));
}

std::filesystem::path CellConfig::modbus_client_path() const {
  return state_dir / "modbus-client.sock";
}

std::filesystem::path CellConfig::report_path() const {
  return state_dir / "report.json";
}

std::filesystem::path CellConfig::journal_path() const {
  return state_dir / "executive.json";
}

CellReading read_cell_document(settings::TomlDocument& document, const std::filesystem::path& file) {
  CellReading reading;
  CellConfig& config = reading.config;
  config.file = file;
  const TomlTable root = document.root();
  const std::filesystem::path folder = file.parent_path();
  const TomlTable cell = root.table("cell");
  config.name = cell.text("name", config.name);
  const std::string state_dir = cell.text("state_dir", {});
  config.state_dir = state_dir.empty() ? default_state_dir(config.name) : folder / state_dir;
  read_clock(root.table("clock"), config.clock);
  config.engine = read_engine(root.table("runtime"));
  config.cpu = read_cpu(root.table("runtime"));
  config.memory_limit_mb =
      static_cast<std::uint32_t>(root.table("runtime").integer("memory_limit_mb", 0, {0, 1'000'000}));
  config.tasks = read_tasks(root);
  config.plant.described = root.has_table("plant");
  read_plant(root.table("plant"), folder, config.clock, config.plant);
  const TomlTable image = root.table("image");
  config.image.input_bytes = static_cast<std::uint32_t>(image.integer("input_bytes", 64, {1, 65'536}));
  config.image.output_bytes = static_cast<std::uint32_t>(image.integer("output_bytes", 64, {1, 65'536}));
  read_safe_state(root.table("safe_state"), config);
  result::Diagnostics found = read_safety(root, config.image.output_bytes, config.safety);
  config.modbus_client = read_modbus_client(root,
                                            {config.safety.io.modbus, config.clock.mode == ClockMode::Real,
                                             config.image.input_bytes, config.image.output_bytes},
                                            found);
  config.modbus_client_metrics = read_metrics(root.table("modbus").table("client"));
  config.mission = missions::read_mission(root, {folder, config.safety.io.shared_memory});
  for (const TomlTable& fault : root.tables("faults"))
    config.faults.push_back(read_fault(fault, config.mission));
  const TomlTable executive = root.table("executive");
  config.executive.max_replans = static_cast<int>(executive.integer("max_replans", 8, {0, 1'000}));
  config.executive.report_fluent = executive.text("report_fluent", {});
  config.executive.settle = std::chrono::milliseconds(executive.integer("settle_ms", 3'000, {0, 600'000}));
  // What moves outside of a simulation is started by somebody who sees it.
  const std::string starter = config.safety.io.shared_memory ? "operator" : "auto";
  config.executive.start = executive.choice("start", starter, {"auto", "operator"}) == "operator"
                               ? RunStart::Operator
                               : RunStart::Auto;
  config.executive.what_if =
      std::chrono::milliseconds(executive.integer("what_if_ms", 10'000, {1, 86'400'000}));
  config.executive.what_if_mb =
      static_cast<std::size_t>(executive.integer("what_if_mb", 512, {16, 1'048'576}));
  config.tags = read_tags(root.table("tags"));
  config.monitors = read_monitors(root, folder);
  const TomlTable dds = root.table("dds");
  config.dds.domain_id = static_cast<std::uint32_t>(dds.integer("domain_id", 0, {0, 232}));
  config.dds.runtime_id = dds.text("runtime_id", config.name);
  read_addresses(dds, config.dds);
  config.dds.place = dds.text("place", place_of(config.state_dir));
  if (config.dds.place == "any") config.dds.place.clear();
  config.change = read_change(root);
  const result::Diagnostics controller = read_controller(root, folder, config.controller);
  config.hmi = read_hmi(root.table("hmi"), folder, config.state_dir);
  const result::Diagnostics described = read_tag_table(config.hmi.tags, config.tags);
  result::Diagnostics secrets;
  config.notify = read_notify(root, folder, secrets);
  config.log = log::read_log(root, folder);
  read_retain(root, folder, config.state_dir, config.retain, config.boot);
  config.record = read_record(root.table("record"), config.state_dir);
  config.history = read_history(root.table("history"), folder, config.state_dir);
  const result::Diagnostics unserved =
      read_modbus_server(root.table("modbus").table("server"), config.modbus_server);
  const result::Diagnostics closed =
      read_modbus_acceptors(root.table("modbus").table("server"), folder, config.modbus_server.tcp,
                            config.modbus_server.server, config.modbus_server.acceptors);
  check_names(cell, dds, config);
  const result::Diagnostics lost = check_written_files(config);
  config.values = document.values();
  reading.problems = document.finish([](std::string_view table, std::string_view key) {
    return settings::advice_of(cell_keys(), table, key);
  });
  for (const result::Diagnostics& more : {found, controller, unserved, closed, described, secrets, lost})
    reading.problems.insert(reading.problems.end(), more.begin(), more.end());
  return reading;
}

CellReading read_cell_config(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  std::error_code unknown;  // what is known of it is said by who reads it
  if (!std::filesystem::exists(file, unknown) && !unknown)
    return unread(
        file, overrides,
        result::fail("M0012", {file.string(), 0, 0}, "there is no such cell",
                     "name the cell's file, or go to its folder; `stepwright new NAME` makes a cell")
            .value());
  if (std::filesystem::is_directory(file, unknown)) {
    const std::filesystem::path inside = file / "cell.toml";
    const bool there = std::filesystem::exists(inside, unknown);
    return unread(file, overrides,
                  result::fail("M0012", {file.string(), 0, 0}, "this is a folder, and no cell",
                               there ? "did you mean '" + inside.lexically_normal().string() + "'?"
                                     : "name the cell's file; `stepwright new NAME` makes a cell")
                      .value());
  }
  auto document = settings::TomlDocument::load(file);
  if (!document) return unread(file, overrides, std::move(document.error()));
  for (const std::string& entry : overrides) {
    const std::size_t equals = entry.find('=');
    if (equals == std::string::npos)
      return unread(file, overrides,
                    result::fail("C0001", {"--set " + entry, 0, 0}, "this is not KEY=VALUE: there is no '='",
                                 "for example --set plant.seed=7")
                        .value());
    auto applied = (*document)->override_value(entry.substr(0, equals), entry.substr(equals + 1));
    if (!applied) return unread(file, overrides, std::move(applied.error()));
  }
  CellReading reading = read_cell_document(**document, file);
  reading.config.overrides = overrides;
  return reading;
}

result::Result<CellConfig> load_cell_config(const std::filesystem::path& file,
                                            const std::vector<std::string>& overrides) {
  CellReading reading = read_cell_config(file, overrides);
  if (result::has_errors(reading.problems)) return tl::unexpected(std::move(reading.problems));
  return std::move(reading.config);
}

}  // namespace stepwright::config

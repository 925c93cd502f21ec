#include "programs/config/cell_config.h"

#include <array>
#include <cstdio>
#include <span>

#include "runtime/base/hash64.h"
#include "runtime/settings/toml_document.h"

namespace stepwright::config {
namespace {

using settings::TomlTable;

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

void read_plant(const TomlTable& table, PlantConfig& plant) {
  plant.kind = table.choice("kind", plant.kind, {"tank_bench", "none"});
  plant.seed = static_cast<std::uint64_t>(table.integer("seed", 1, {0, 1e15}));
  plant.uncertainty = table.boolean("uncertainty", plant.uncertainty);
  const TomlTable ports = table.table("ports");
  for (const std::string& port : ports.keys())
    plant.ports.push_back({port, ports.text(port, {}), ports.where(port)});
}

void read_safe_state(const TomlTable& table, CellConfig& config) {
  const std::string policy = table.choice("on_lost_supervisor", "continue", {"continue", "safe"});
  config.on_lost_supervisor = policy == "safe" ? LostSupervisorPolicy::Safe : LostSupervisorPolicy::Continue;
  config.supervisor_lost_after =
      std::chrono::milliseconds(table.integer("supervisor_lost_after_ms", 1'000, {100, 600'000}));
  const TomlTable outputs = table.table("outputs");
  for (const std::string& address : outputs.keys()) {
    const std::string action = outputs.choice(address, "zero", {"zero", "hold", "one"});
    config.safe_outputs.push_back({address, action == "hold"  ? SafeAction::Hold
                                            : action == "one" ? SafeAction::One
                                                              : SafeAction::Zero});
  }
}

std::filesystem::path required_file(const TomlTable& table, const char* key,
                                    const std::filesystem::path& folder) {
  const std::string text = table.required_text(key);
  if (text.empty()) return {};
  const std::filesystem::path path = folder / text;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    table.report(key, "there is no file " + path.string(), "paths are taken from the folder of this file");
  }
  return path;
}

void read_planning(const TomlTable& table, const std::filesystem::path& folder, PlanningConfig& planning) {
  planning.domain = required_file(table, "domain", folder);
  planning.problem = required_file(table, "problem", folder);
  planning.binding = required_file(table, "binding", folder);
  planning.optimal = table.boolean("optimal", planning.optimal);
  planning.sequential = table.boolean("sequential", planning.sequential);
  planning.time = std::chrono::milliseconds(table.integer("time_ms", planning.time.count(), {1, 86'400'000}));
}

}  // namespace

std::filesystem::path temporary_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  return error ? std::filesystem::path("/tmp") : folder;
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

std::filesystem::path CellConfig::report_path() const {
  return state_dir / "report.json";
}

std::filesystem::path CellConfig::journal_path() const {
  return state_dir / "executive.json";
}

result::Result<CellConfig> load_cell_config(const std::filesystem::path& file,
                                            const std::vector<std::string>& overrides) {
  auto document = settings::TomlDocument::load(file);
  if (!document) return result::forward(document);
  for (const std::string& entry : overrides) {
    const std::size_t equals = entry.find('=');
    const std::string key = entry.substr(0, equals);
    auto applied =
        (*document)->override_value(key, equals == std::string::npos ? "" : entry.substr(equals + 1));
    if (!applied) return tl::unexpected(std::move(applied.error()));
  }
  const TomlTable root = (*document)->root();
  const std::filesystem::path folder = file.parent_path();
  CellConfig config;
  config.file = file;
  const TomlTable cell = root.table("cell");
  config.name = cell.text("name", config.name);
  const std::string state_dir = cell.text("state_dir", {});
  config.state_dir =
      state_dir.empty() ? temporary_folder() / ("stepwright-" + config.name) : folder / state_dir;
  read_clock(root.table("clock"), config.clock);
  config.engine = read_engine(root.table("runtime"));
  read_plant(root.table("plant"), config.plant);
  const TomlTable image = root.table("image");
  config.image.input_bytes = static_cast<std::uint32_t>(image.integer("input_bytes", 64, {1, 65'536}));
  config.image.output_bytes = static_cast<std::uint32_t>(image.integer("output_bytes", 64, {1, 65'536}));
  read_safe_state(root.table("safe_state"), config);
  if (root.has("planning")) read_planning(root.table("planning"), folder, config.planning);
  for (const TomlTable& fault : root.tables("faults")) {
    config.faults.push_back({fault.required_number("at_s", {0.0, 1e9}), fault.required_text("name"),
                             fault.required_number("value")});
  }
  const TomlTable executive = root.table("executive");
  config.executive.max_replans = static_cast<int>(executive.integer("max_replans", 8, {0, 1'000}));
  config.executive.report_fluent = executive.text("report_fluent", {});
  config.executive.settle = std::chrono::milliseconds(executive.integer("settle_ms", 3'000, {0, 600'000}));
  const TomlTable dds = root.table("dds");
  config.dds.domain_id = static_cast<std::uint32_t>(dds.integer("domain_id", 0, {0, 232}));
  config.dds.runtime_id = dds.text("runtime_id", config.name);
  config.change = read_change(root);
  const TomlTable hmi = root.table("hmi");
  config.hmi.host = hmi.text("host", config.hmi.host);
  config.hmi.port = static_cast<std::uint16_t>(hmi.integer("port", 8080, {0, 65'535}));
  read_retain(root, folder, config.state_dir, config.retain, config.boot);
  result::Diagnostics problems = (*document)->finish();
  if (result::has_errors(problems)) return tl::unexpected(std::move(problems));
  return config;
}

}  // namespace stepwright::config

#pragma once

// The one configuration file of a cell, shared by all its processes (tests/cells/<cell>/cell.toml).
//
//   auto config = load_cell_config("tests/cells/bench/cell.toml", {"plant.seed=7"});
//
// Relative paths in the file are taken from the file's folder. Every field has a safe default; unknown keys,
// wrong types and values out of range are diagnostics with their place (C0001 to C0006). C0461: a name that
// cannot name a runtime or a folder; C0462: a state folder whose socket would have too long a path; C0466: no
// IPv4 address.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cell/config/change_config.h"
#include "cell/config/controller_config.h"
#include "cell/config/fleet_config.h"
#include "cell/config/hmi_config.h"
#include "cell/config/metrics_config.h"
#include "cell/config/modbus_client_config.h"
#include "cell/config/modbus_server_config.h"
#include "cell/config/monitor_config.h"
#include "cell/config/notify_config.h"
#include "cell/config/record_config.h"
#include "cell/config/retain_config.h"
#include "cell/config/robot_cell_config.h"
#include "cell/config/safety_config.h"
#include "cell/config/stepped_config.h"
#include "cell/config/tag_config.h"
#include "cell/config/task_config.h"
#include "cell/config/tugger_config.h"
#include "cell/missions/table/mission_tables.h"
#include "runtime/ground/log/log_config.h"
#include "runtime/ground/result/result.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

enum class ClockMode : std::uint8_t { Simulated, Real };
enum class LostSupervisorPolicy : std::uint8_t { Continue, Safe };
enum class RunStart : std::uint8_t { Auto, Operator };
enum class EngineKind : std::uint8_t { Auto, Native, Vm };

struct ClockConfig {
  ClockMode mode = ClockMode::Simulated;
  double speed = 0.0;                 // simulated: times real time; 0 = as fast as possible
  std::int64_t interval_us = 10'000;  // tick of the scan without a program; a program's tasks bring their own
};

// Where a terminal of the plant is in the process image.
struct PortAddress {
  std::string port;     // "fc1"
  std::string address;  // "%IX0.0"
  result::Location where;
};

struct PlantConfig {
  std::string kind = "tank_bench";  // or "sorting_line", "fleet", "tugger" or "robot_cell"; "model": of a
                                    // file; "shared", "fmu" or "st": a model in a process of its own; or
                                    // "none": outputs go nowhere, inputs stay 0
  std::uint64_t seed = 1;           // of all that is uncertain
  bool uncertainty = true;          // the bench: sensor bias, drift and noise; the line: boxes that differ; a
                                    // fleet, a tugger train and a robot cell: noise of their sensors
  std::filesystem::path file;       // of a model (plant_models/doc/components.md)
  result::Location file_where;
  std::size_t diverters = 2;        // of the line; 1 to 4
  std::size_t boxes = 5;            // of the line's order list; 1 to 9
  FleetPlantConfig fleet;           // of kind "fleet" only
  TuggerPlantConfig tugger;         // of kind "tugger" only
  RobotCellPlantConfig robot_cell;  // of kind "robot_cell" only
  SteppedPlantConfig stepped;       // of the kinds "shared", "fmu" and "st" only
  std::vector<PortAddress> ports;
  std::filesystem::path log;  // of its processes, set by who runs it; empty: the output of that program
  bool described = false;     // the file has a table [plant]; without one there is none
};

// Something that goes wrong at a given plant time: a fault of the plant by its name ("leak_a1"), or a change
// of what is asked for, named by its fluent ("(demand c1)"), which the supervisor learns of at its next
// decision.
struct ScheduledFault {
  double at_s = 0.0;
  std::string name;
  double value = 0.0;
  result::Location where;
};

// True for a change of what is asked for, false for a fault of the plant.
bool is_goal_change(const ScheduledFault& fault);

struct ImageConfig {
  std::uint32_t input_bytes = 64;  // sizes of the areas that the I/O driver sees; a program may use less
  std::uint32_t output_bytes = 64;
};

struct ExecutiveConfig {
  int max_replans = 8;                      // then the plant is left in its safe state
  std::string report_fluent;                // what the report follows per action; empty: the metric
  std::chrono::milliseconds settle{3'000};  // plant time over which sensors are averaged before a decision
  // "operator": a plan is shown and waits until somebody starts it, also after a restart of the supervisor
  // when the run before had ended
  RunStart start = RunStart::Auto;
  std::chrono::milliseconds what_if{10'000};  // budget of a plan that is only looked at
  std::size_t what_if_mb = 512;               // likewise: by which the supervisor may grow for it
};

struct DdsConfig {
  std::uint32_t domain_id = 0;
  std::string
      runtime_id;  // this cell's runtime in the domain, which no other may share; default: the cell's name
  // IPv4 addresses of this machine that Fast DDS may use; nothing listens on any other.
  std::vector<std::string> interfaces = {"127.0.0.1"};
  std::vector<std::string> peers;  // IPv4 addresses of other machines, where multicast does not reach
  // Where the runtime lives, as its link says it; empty: wherever. Default: this machine, this state folder.
  std::string place;
};

struct CellConfig {
  std::filesystem::path file;          // the configuration file itself
  std::vector<std::string> overrides;  // "dotted.key=value", which won over the file
  std::string name = "cell";           // also the id of the cell's runtime on Fast DDS
  std::filesystem::path state_dir;  // sockets, journals and reports; created on demand (default: a folder of
                                    // the name in the temporary folder)
  ClockConfig clock;
  EngineKind engine = EngineKind::Auto;  // [runtime] engine: "auto" is native where the machine can
  std::uint32_t memory_limit_mb = 0;  // [runtime] memory_limit_mb: of the runtime's process; 0: the system's
  int cpu = -1;                       // [runtime] cpu: the only processor of the scan; -1: any
  std::vector<TaskConfig> tasks;
  PlantConfig plant;
  ImageConfig image;
  std::vector<ScheduledFault> faults;
  std::vector<TagConfig> tags;          // [tags]: unit, description, range of tags, for people
  std::vector<MonitorConfig> monitors;  // [[monitors]]: formulas that the scan watches
  SafetyConfig safety;  // [safe_state] by cause and output, [watchdog], [tasks.NAME], [guard], [io]
  LostSupervisorPolicy on_lost_supervisor = LostSupervisorPolicy::Continue;
  std::chrono::milliseconds supervisor_lost_after{1'000};
  missions::CellMission mission;  // the table of its planner, [planning], [fleet]; or none
  ExecutiveConfig executive;
  DdsConfig dds;
  HmiConfig hmi;
  std::vector<NotifyConfig> notify;  // [[notify]]: who is told of alarms
  ChangeConfig change;
  ControllerConfig controller;  // where the program runs: in `stepwright runtime`, or behind Modbus
  RetainSection retain;
  BootSection boot;
  RecordConfig record;
  HistoryConfig history;
  ModbusServerConfig modbus_server;
  modbus::client::ClientSettings modbus_client;  // [modbus.client], [modbus.lines], [[modbus.device]]
  MetricsConfig modbus_client_metrics;           // [modbus.client.metrics]
  stepwright::log::LogConfig log;
  settings::SettingTexts values;  // everything that the file says, to compare it with what it says later

  std::filesystem::path socket_path() const;   // the runtime's Unix socket
  std::filesystem::path journal_path() const;  // the executive's journal
  // File of the simulated plant's state, which survives its process; of this state folder, kept in memory.
  std::filesystem::path plant_memory_path() const;
  std::filesystem::path modbus_client_path() const;  // where `stepwright modbus-client` answers
  std::filesystem::path report_path() const;         // what the supervisor leaves at the end of a run
};

// That of the environment or, if it names none that exists, /tmp.
std::filesystem::path temporary_folder();

// A file as far as it can be read: what is wrong in it has its default in `config` and its diagnostic in
// `problems`, so that a check can go on and find everything else.
struct CellReading {
  CellConfig config;
  result::Diagnostics problems;

  // Nothing of the file could be read.
  bool is_unread() const { return config.values.empty() && result::has_errors(problems); }
};

[[nodiscard]] CellReading read_cell_config(const std::filesystem::path& file,
                                           const std::vector<std::string>& overrides = {});

// The same, of a document that somebody has loaded, and may listen to.
[[nodiscard]] CellReading read_cell_document(settings::TomlDocument& document,
                                             const std::filesystem::path& file);

// As the first, for whoever wants to run the cell: any error is a refusal.
// `overrides` are "dotted.key=value" texts that win over the file (--set).
[[nodiscard]] result::Result<CellConfig> load_cell_config(const std::filesystem::path& file,
                                                          const std::vector<std::string>& overrides = {});

}  // namespace stepwright::config

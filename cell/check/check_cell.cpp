#include "cell/check/check_cell.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

#include "cell/binding/check_binding.h"
#include "cell/check/check_addresses.h"
#include "cell/check/check_places.h"
#include "cell/check/check_plant.h"
#include "cell/check/check_ports.h"
#include "cell/check/check_processes.h"
#include "cell/check/check_program.h"
#include "cell/check/check_texts.h"
#include "cell/check/check_unheard.h"
#include "cell/config/state_dir.h"
#include "cell/hmi/alarm_list.h"
#include "cell/hmi/plant_picture.h"
#include "cell/missions/mission_kinds.h"
#include "cell/monitors/cell_monitors.h"
#include "cell/program/compile_cell.h"
#include "cell/runtime/cell_io.h"
#include "cell/runtime/host_options.h"
#include "hmi_web/alarms/engine.h"
#include "hmi_web/drawing/drawing_file.h"
#include "hmi_web/recipes/definition_file.h"
#include "hmi_web/screens/codes.h"
#include "hmi_web/screens/screen_store.h"
#include "runtime/ground/process/diagnostics_json.h"

namespace stepwright::check {
namespace {

// The first plan of its planner, as the supervisor would make it at its start.
void check_mission(const config::CellConfig& config, CheckReport& report) {
  auto planner = missions::open(config);
  if (!planner) return add(report.problems, planner.error());
  const auto first = (*planner)->first_plan();
  if (!first) return add(report.problems, first.error());
  add(report.problems, first->warnings);
  report.no_plan = first->no_plan;
  report.plan_exit = first->exit;
  if (first->program.empty()) return;
  report.program = "the program of the plan";
  add(report.problems, check_program(config, {report.program, first->program}));
  report.plan = {first->actions, first->cost, first->program.size()};
}

// What each monitor watches, in plain words, or what is wrong with it.
void check_monitors(const config::CellConfig& config, result::Diagnostics& problems) {
  const auto monitors = cell_monitors::cell_monitors(config);
  if (!monitors) return add(problems, monitors.error());
  for (const cell_monitors::CellMonitor& each : *monitors)
    problems.push_back({"C0559",
                        result::Severity::Note,
                        each.where,
                        "monitor '" + each.name + "': " + cell_monitors::sentence_of(each),
                        {}});
}

// A sound report must not be taken for more than it is.
void note_unknown(const config::CellConfig& config, result::Diagnostics& problems) {
  const bool ranges = config.modbus_server.enabled && !config.modbus_server.map.ranges.empty();
  const bool tags = !config.modbus_client.devices.empty();
  if (config.mission.table || (!ranges && !tags)) return;
  const result::Location where =
      ranges ? config.modbus_server.map.ranges.front().where : config.modbus_client.devices.front().where;
  problems.push_back({"C0530", result::Severity::Note, where,
                      "no program is known to check the variables of the register map and of tags against",
                      "--program IMAGE.swb, or [runtime] program"});
}

// The program that is there without planning: that of the cell's sources, as `stepwright up` would make it,
// or the one that is there already.
void check_image(const config::CellConfig& config, const std::filesystem::path& image, CheckReport& report) {
  if (image.empty() && !config.boot.sources.empty()) {
    auto made = cell_program::compile_cell(config, report.problems);
    if (!made) return;
    report.program = config.boot.sources.front().string();
    return add(report.problems, check_program(config, {report.program, std::move(*made)}));
  }
  auto program = find_program(config, image);
  if (!program) return add(report.problems, program.error());
  if (!*program) return note_unknown(config, report.problems);
  report.program = (*program)->name;
  add(report.problems, check_program(config, **program));
}

// The plant's own picture only shows.
void note_idle_parts(const std::vector<drawing::Part>& parts, result::Diagnostics& problems) {
  const auto part =
      std::ranges::find_if(parts, [](const drawing::Part& each) { return drawing::writes(each.kind); });
  if (part == parts.end()) return;
  problems.push_back({screens::kPartNeverWrites, result::Severity::Warning, part->where,
                      "the operator part '" + part->key + "' of [hmi] drawing does nothing: only screens act",
                      "put the file into [hmi] screens_dir as NAME.svg"});
}

// What is wrong in them, or drawn otherwise than it stands there.
void check_drawings(const config::HmiConfig& hmi, result::Diagnostics& problems) {
  if (!hmi.drawing.empty()) {
    const auto drawn = drawing::load_drawing(hmi.drawing);
    add(problems, drawn ? drawn->warnings : drawn.error());
    if (drawn) note_idle_parts(drawn->parts, problems);
  }
  std::error_code unknown;  // as good as not there: check_places says why
  if (!std::filesystem::is_directory(hmi.screens_dir, unknown)) return;
  const auto store = screens::ScreenStore::open(hmi.screens_dir);
  if (!store) return;
  add(problems, (*store)->damaged());
  for (const screens::Screen& screen : (*store)->list()) {
    const screens::Version* const now = screen.current();
    if (now == nullptr || now->removed) continue;
    if (const auto drawn = (*store)->read(screen.name, now->number)) add(problems, drawn->warnings);
  }
}

// As the page would have them: with the built-in ones, so that a name of one of those is found.
void check_alarms(const config::CellConfig& config, result::Diagnostics& problems) {
  if (config.history.alarms.empty()) return;
  const auto picture = hmi::picture_of(config.plant);
  const auto all = hmi::alarms_of(config, picture ? picture->synoptic : protocol::Synoptic());
  if (!all) return add(problems, all.error());
  if (const auto engine = alarms::AlarmEngine::create(*all); !engine) add(problems, engine.error());
}

// In the order of the file.
void sort(result::Diagnostics& problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const auto& a, const auto& b) {
    return std::tie(a.where.file, a.where.line) < std::tie(b.where.file, b.where.line);
  });
}

}  // namespace

std::size_t CheckReport::warnings() const {
  return static_cast<std::size_t>(
      std::ranges::count(problems, result::Severity::Warning, &result::Diagnostic::severity));
}

result::ExitCode CheckReport::exit() const {
  return result::has_errors(problems) ? result::ExitCode::BadInput : plan_exit;
}

CheckReport check_cell(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                       const std::filesystem::path& image) {
  config::CellReading cell = config::read_cell_config(file, overrides);
  CheckReport report;
  report.file = file;
  report.problems = std::move(cell.problems);
  if (auto options = cell_runtime::host_options(cell.config); !options) add(report.problems, options.error());
  add(report.problems, cell_runtime::check_cell_io(cell.config));
  add(report.problems, check_plant(cell.config));
  add(report.problems, check_processes(cell.config));
  add(report.problems, check_ports(cell.config));
  add(report.problems, check_addresses(cell.config));
  add(report.problems, check_texts(cell.config));
  add(report.problems, check_unheard(cell.config));
  add(report.problems, check_places(cell.config));
  if (const auto trusted = config::check_state_dir(cell.config); !trusted)
    add(report.problems, trusted.error());
  check_monitors(cell.config, report.problems);
  add(report.problems, cell_binding::check_binding(cell.config));
  check_alarms(cell.config, report.problems);
  if (!cell.config.hmi.recipes.empty()) {
    if (const auto tags = recipes::load_definitions(cell.config.hmi.recipes); !tags)
      add(report.problems, tags.error());
  }
  check_drawings(cell.config.hmi, report.problems);
  check_image(cell.config, image, report);
  // Planning costs seconds: not for a file that has to be changed anyway.
  if (cell.config.mission.table && !result::has_errors(report.problems)) check_mission(cell.config, report);
  sort(report.problems);
  return report;
}

std::string to_json(const CheckReport& report) {
  nlohmann::json json = {{"file", report.file.string()},
                         {"sound", report.sound()},
                         {"warnings", report.warnings()},
                         {"diagnostics", process::diagnostics_json(report.problems)}};
  if (!report.program.empty()) json["program"] = report.program;
  if (report.plan) {
    json["plan_steps"] = report.plan->actions;
    json["plan_cost"] = report.plan->cost;
    json["program_bytes"] = report.plan->program_bytes;
  }
  if (!report.no_plan.empty()) json["no_plan"] = report.no_plan;
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace stepwright::check

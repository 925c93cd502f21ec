#include "programs/up/status_command.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "cell/processes/kept_process.h"
#include "programs/up/ask_program.h"
#include "programs/up/cell_lock.h"
#include "programs/up/find_up_process.h"
#include "runtime/ground/process/command_line.h"
#include "runtime/ground/result/counted.h"

namespace stepwright::up {
namespace {

using process::fail;
using processes::CellRecord;
using processes::ProcessRecord;
using result::ExitCode;

bool is_ready(const ProcessRecord& each) {
  return each.phase == to_string(processes::Phase::Ready);
}

// Whether something serves the socket of the cell's runtime: a controller that is loaded by hand does not.
bool has_runtime(const config::CellConfig& config, const CellRecord& record) {
  const auto scans = [](const ProcessRecord& each) {
    return (each.name == "runtime" || each.name == "gateway") && is_ready(each);
  };
  return !config.controller.loaded_by_hand && std::ranges::any_of(record.processes, scans);
}

bool has_failed(const CellRecord& record, const config::CellConfig& config) {
  return record.program && (is_in_fault(*record.program) || is_missing(*record.program, config));
}

void print(const CellRecord& record) {
  std::printf("cell '%s': %s, page %s, process %d\n", record.cell.c_str(), record.ready ? "up" : "coming up",
              record.address.empty() ? "not yet" : record.address.c_str(), static_cast<int>(record.pid));
  for (const ProcessRecord& each : record.processes) {
    std::printf("  %-14s %-10s", each.name.c_str(), each.phase.c_str());
    if (each.pid != 0) std::printf(" process %d", static_cast<int>(each.pid));
    if (each.restarts != 0)
      std::printf(", started again %s",
                  result::counted(static_cast<std::uint64_t>(each.restarts), "time", "times").c_str());
    if (!each.reason.empty())
      std::printf("%s it %s", each.restarts != 0 ? ", the last time because" : ":", each.reason.c_str());
    std::printf("\n");
  }
  if (!record.program) return;
  std::printf("  program %s (%s)", record.program->state.c_str(), record.program->mode.c_str());
  if (!record.program->detail.empty()) std::printf(": %s", record.program->detail.c_str());
  std::printf("\n");
}

// What the last `up` of this cell had to kill at its end.
std::vector<std::string> killed_last(const config::CellConfig& config) {
  const auto record = processes::read_record(processes::record_path(config));
  const bool known = record && processes::check_same_cell(*record, config);
  return known ? record->killed : std::vector<std::string>();
}

void print_not_up(const config::CellConfig& config, bool json) {
  CellRecord record;
  record.cell = config.name;
  record.config = processes::whole_path(config.file);
  record.killed = killed_last(config);
  if (json) {
    std::fputs(processes::to_json(record).c_str(), stdout);
    return;
  }
  std::printf("cell '%s' is not up; `stepwright up %s` brings it up\n", config.name.c_str(),
              config.file.c_str());
  for (const std::string& name : record.killed) {
    const std::string left = processes::left_behind_by(name);
    std::printf("  %-14s did not end and was killed%s\n", name.c_str(),
                left.empty() ? "" : (": " + left).c_str());
  }
}

// Somebody keeps the cell of this file up, and its state folder does not say so.
result::Result<void> check_unknown(const Options& options) {
  const auto pid = find_up_process(options);
  if (!pid) return {};
  return result::fail(
      "M0024", {options.cell, 0, 0},
      "process " + std::to_string(*pid) + " keeps this cell up, and its state folder knows nothing of it",
      "was the folder removed, or the file changed meanwhile? `stepwright down " + options.cell +
          "` ends it");
}

}  // namespace

int run_status(const Options& options) {
  const auto config = load_for_a_look(options);
  result::Result<std::optional<CellRecord>> found = std::optional<CellRecord>();
  if (config) found = find_cell(*config);
  if (!found) return fail(found.error(), ExitCode::RuntimeFault);
  if (!*found) {
    if (const auto known = check_unknown(options); !known) {
      if (!config) std::fprintf(stderr, "%s\n", result::to_string(config.error()).c_str());
      return fail(known.error(), ExitCode::RuntimeFault);
    }
    if (!config) return fail(config.error(), ExitCode::BadInput);
    print_not_up(*config, options.json);
    return to_int(ExitCode::RuntimeFault);
  }
  CellRecord record = **found;
  if (has_runtime(*config, record)) record.program = ask_program(*config, record.clock);
  if (options.json) {
    std::fputs(processes::to_json(record).c_str(), stdout);
  } else {
    print(record);
  }
  const bool whole =
      record.ready && std::ranges::all_of(record.processes, is_ready) && !has_failed(record, *config);
  return to_int(whole ? ExitCode::Done : ExitCode::RuntimeFault);
}

}  // namespace stepwright::up

#include "programs/up/down_command.h"

#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "cell/processes/kept_process.h"
#include "programs/up/cell_lock.h"
#include "runtime/ground/process/command_line.h"

namespace stepwright::up {
namespace {

using process::fail;
using processes::CellRecord;
using processes::ProcessRecord;
using result::ExitCode;
using std::chrono::milliseconds;

constexpr milliseconds kLook{50};
// More than all processes together may take.
constexpr std::chrono::seconds kMostWait{90};

bool is_ready(const ProcessRecord& each) {
  return each.phase == to_string(processes::Phase::Ready);
}

void print(const CellRecord& record) {
  std::printf("cell '%s': %s, page %s, process %d\n", record.cell.c_str(), record.ready ? "up" : "coming up",
              record.address.empty() ? "not yet" : record.address.c_str(), static_cast<int>(record.pid));
  for (const ProcessRecord& each : record.processes) {
    std::printf("  %-14s %-10s", each.name.c_str(), each.phase.c_str());
    if (each.pid != 0) std::printf(" process %d", static_cast<int>(each.pid));
    if (each.restarts != 0) std::printf(", started again %d times", each.restarts);
    std::printf("\n");
  }
}

void print_not_up(const config::CellConfig& config, bool json) {
  if (json) {
    CellRecord record;
    record.cell = config.name;
    record.config = std::filesystem::absolute(config.file).lexically_normal().string();
    std::fputs(processes::to_json(record).c_str(), stdout);
    return;
  }
  std::printf("cell '%s' is not up; `stepwright up %s` brings it up\n", config.name.c_str(),
              config.file.c_str());
}

}  // namespace

int run_status(const Options& options) {
  const auto config = load_for_a_look(options);
  if (!config) return fail(config.error(), ExitCode::BadInput);
  const auto found = find_cell(*config);
  if (!found) return fail(found.error(), ExitCode::RuntimeFault);
  if (!*found) {
    print_not_up(*config, options.json);
    return to_int(ExitCode::RuntimeFault);
  }
  const CellRecord& record = **found;
  if (options.json) {
    std::fputs(processes::to_json(record).c_str(), stdout);
  } else {
    print(record);
  }
  const bool whole = record.ready && std::ranges::all_of(record.processes, is_ready);
  return to_int(whole ? ExitCode::Done : ExitCode::RuntimeFault);
}

int run_down(const Options& options) {
  const auto config = load_for_a_look(options);
  if (!config) return fail(config.error(), ExitCode::BadInput);
  auto found = find_cell(*config);
  if (found && !*found) {
    std::printf("cell '%s' is not up\n", config->name.c_str());
    return to_int(ExitCode::Done);
  }
  if (!found) return fail(found.error(), ExitCode::RuntimeFault);
  const pid_t pid = (*found)->pid;
  if (kill(pid, SIGTERM) != 0 && errno != ESRCH) {
    const auto refused =
        result::fail("M0016", {config->file.string(), 0, 0},
                     "process " + std::to_string(pid) +
                         ", which keeps the cell up, takes no signal: " + std::strerror(errno),
                     "be the user who has started it");
    return fail(refused.value(), ExitCode::RuntimeFault);
  }
  const auto deadline = std::chrono::steady_clock::now() + kMostWait;
  while (found && *found && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(kLook);
    found = find_cell(*config);
    // Its record goes before its lock.
    if (!found) found = std::optional<CellRecord>(CellRecord{});
  }
  if (found && *found) {
    const auto late = result::fail("M0016", {config->file.string(), 0, 0},
                                   "the cell '" + config->name + "' does not go down",
                                   "`stepwright status " + config->file.string() + "` shows what still runs");
    return fail(late.value(), ExitCode::RuntimeFault);
  }
  std::printf("cell '%s' is down\n", config->name.c_str());
  return to_int(ExitCode::Done);
}

}  // namespace stepwright::up

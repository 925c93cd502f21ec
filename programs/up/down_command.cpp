#include "programs/up/down_command.h"

#include <signal.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <thread>

#include "cell/processes/cell_record.h"
#include "programs/up/cell_lock.h"
#include "runtime/ground/process/command_line.h"

namespace stepwright::up {
namespace {

using process::fail;
using processes::CellRecord;
using result::ExitCode;
using std::chrono::milliseconds;

constexpr milliseconds kLook{50};
// More than all processes together may take.
constexpr std::chrono::seconds kMostWait{90};

// What that `up` has left behind which has just ended.
result::Diagnostics left_behind(const config::CellConfig& config, pid_t pid) {
  result::Diagnostics problems;
  const auto record = processes::read_record(processes::record_path(config));
  if (!record || record->pid != pid) return problems;
  for (const std::string& name : record->killed) {
    const std::string left = processes::left_behind_by(name);
    problems.push_back({"M0021",
                        result::Severity::Error,
                        {config.file.string(), 0, 0},
                        name + " did not end and was killed" + (left.empty() ? "" : ": " + left),
                        "the log of `stepwright up` has what it said last"});
  }
  return problems;
}

}  // namespace

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
    // Its record goes before its lock; or another cell is up there by now.
    if (!found && found.error().front().code == processes::kOfAnotherCell) found = std::nullopt;
    if (!found) found = std::optional<CellRecord>(CellRecord{});
  }
  if (found && *found) {
    const auto late = result::fail("M0016", {config->file.string(), 0, 0},
                                   "the cell '" + config->name + "' does not go down",
                                   "`stepwright status " + config->file.string() + "` shows what still runs");
    return fail(late.value(), ExitCode::RuntimeFault);
  }
  std::printf("cell '%s' is down\n", config->name.c_str());
  const result::Diagnostics problems = left_behind(*config, pid);
  return problems.empty() ? to_int(ExitCode::Done) : fail(problems, ExitCode::RuntimeFault);
}

}  // namespace stepwright::up

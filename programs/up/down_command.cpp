#include "programs/up/down_command.h"

#include <signal.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <optional>
#include <thread>

#include "cell/processes/cell_record.h"
#include "programs/up/cell_lock.h"
#include "programs/up/find_up_process.h"
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

result::Result<void> ask_to_end(pid_t pid, const std::string& file) {
  if (kill(pid, SIGTERM) == 0 || errno == ESRCH) return {};
  return result::fail("M0016", {file, 0, 0},
                      "process " + std::to_string(pid) +
                          ", which keeps the cell up, takes no signal: " + std::strerror(errno),
                      "be the user who has started it");
}

tl::unexpected<result::Diagnostics> stays_up(const std::string& what, const std::string& file) {
  return result::fail("M0016", {file, 0, 0}, what + " does not go down",
                      "`stepwright status " + file + "` shows what still runs");
}

// A cell whose state folder says nothing of it: removed meanwhile, or named by a file that says something
// else by now. Nothing if nobody keeps the cell of this file up.
std::optional<int> end_unknown(const Options& options) {
  const std::string& file = options.cell;
  const auto pid = find_up_process(options);
  if (!pid) return std::nullopt;
  if (const auto asked = ask_to_end(*pid, file); !asked) return fail(asked.error(), ExitCode::RuntimeFault);
  const auto deadline = std::chrono::steady_clock::now() + kMostWait;
  while (find_up_process(options) == pid) {
    if (std::chrono::steady_clock::now() > deadline)
      return fail(stays_up("process " + std::to_string(*pid) + ", which keeps the cell up,", file).value(),
                  ExitCode::RuntimeFault);
    std::this_thread::sleep_for(kLook);
  }
  std::printf("the cell of %s is down: process %d kept it up, of which its state folder knew nothing\n",
              file.c_str(), static_cast<int>(*pid));
  return to_int(ExitCode::Done);
}

}  // namespace

int run_down(const Options& options) {
  const auto config = load_for_a_look(options);
  result::Result<std::optional<CellRecord>> found = std::optional<CellRecord>();
  if (config) found = find_cell(*config);
  if (found && !*found) {
    if (const auto exit = end_unknown(options)) return *exit;
    if (!config) return fail(config.error(), ExitCode::BadInput);
    std::printf("cell '%s' is not up\n", config->name.c_str());
    return to_int(ExitCode::Done);
  }
  if (!found) return fail(found.error(), ExitCode::RuntimeFault);
  const pid_t pid = (*found)->pid;
  if (const auto asked = ask_to_end(pid, config->file.string()); !asked)
    return fail(asked.error(), ExitCode::RuntimeFault);
  const auto deadline = std::chrono::steady_clock::now() + kMostWait;
  while (found && *found && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(kLook);
    found = find_cell(*config);
    // Its record goes before its lock; or another cell is up there by now.
    if (!found && found.error().front().code == processes::kOfAnotherCell) found = std::nullopt;
    if (!found) found = std::optional<CellRecord>(CellRecord{});
  }
  if (found && *found)
    return fail(stays_up("the cell '" + config->name + "'", config->file.string()).value(),
                ExitCode::RuntimeFault);
  std::printf("cell '%s' is down\n", config->name.c_str());
  const result::Diagnostics problems = left_behind(*config, pid);
  return problems.empty() ? to_int(ExitCode::Done) : fail(problems, ExitCode::RuntimeFault);
}

}  // namespace stepwright::up

#pragma once

// Record of a cell that is up: `stepwright up` leaves it in the cell's state folder for `status`, `down` and
// scripts (doc/operate.md).
//
//   write_record(record_path(config), record);
//   const auto record = read_record(record_path(config));
//
// Any thread; one process writes.

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/ground/result/result.h"

namespace stepwright::processes {

struct ProcessRecord {
  std::string name;
  pid_t pid = 0;      // 0: it does not run now
  std::string phase;  // to_string(Phase)
  int restarts = 0;
  std::string reason = {};  // why it was started again last, in a few words

  bool operator==(const ProcessRecord&) const = default;
};

// What the runtime says of the program; only `status` asks it.
struct ProgramRecord {
  std::string state;   // host::name_of(RuntimeState), or "unknown": it does not answer
  std::string mode;    // the clock, and whether it waits for the supervisor
  std::string detail;  // why it is in this state, and what else is to be mended; may be empty

  bool operator==(const ProgramRecord&) const = default;
};

struct CellRecord {
  std::string cell;
  std::string config;   // the cell's file, as a whole path
  pid_t pid = 0;        // of `stepwright up`
  std::string address;  // of the page; empty: it is not served yet
  bool ready = false;   // all of them have been
  std::vector<ProcessRecord> processes;
  std::optional<ProgramRecord> program = {};
  std::string clock = {};                // "real" or "simulated", as `up` was told
  std::vector<std::string> killed = {};  // that did not end when the cell went down

  bool operator==(const CellRecord&) const = default;
};

// What a process that had to be killed leaves behind, in a sentence; empty: nothing that another one does not
// bring to its safe state.
std::string left_behind_by(std::string_view process);

std::filesystem::path record_path(const config::CellConfig& config);

inline constexpr const char* kOfAnotherCell = "M0023";

// As a record has it.
std::string whole_path(const std::filesystem::path& file);
// M0023, with both files, if the record is that of another cell, which has the same state folder. Links and
// the ways to a file make no difference, and a cell that was moved while it is up is the same one.
[[nodiscard]] result::Result<void> check_same_cell(const CellRecord& record,
                                                   const config::CellConfig& config);

// The same for whoever speaks to the runtime of the folder: M0023 if another cell is up there. Without a
// record, or with that of a process that has ended, whoever serves the socket is left to say who he is.
[[nodiscard]] result::Result<void> check_state_folder(const config::CellConfig& config);

std::string to_json(const CellRecord& record);
// E0002 or nothing.
[[nodiscard]] result::Diagnostics write_record(const std::filesystem::path& file, const CellRecord& record);
// E0001: it cannot be read; M0015: it is no such record.
[[nodiscard]] result::Result<CellRecord> read_record(const std::filesystem::path& file);

}  // namespace stepwright::processes

#pragma once

// Settings of a cell for values and programs that outlive the process: [retain], and of [runtime] the keys
// program, autostart and boot.
//
//   [retain]
//   file = "retain.store"     # in the state folder; "" keeps nothing on the disk
//   period_ms = 100           # written at most this often
//   policy = "carry"          # what becomes of values that do not fit the program: "initialise", "refuse"
//   [runtime]
//   program = "line.swb"      # loaded at the start, from the folder of this file
//   sources = ["line.st"]     # what it is compiled from; without `program` it is in the state folder
//   dialect = "matiec"        # the system that the sources come from (ladder/doc/dialects.md)
//   autostart = true          # and started, warm
//   boot = true               # the last program that was downloaded is kept in the state folder and loaded

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"

namespace stepwright::settings {
class TomlTable;
}

namespace stepwright::config {

enum class RetainPolicy : std::uint8_t { Carry, Initialise, Refuse };

struct RetainSection {
  std::filesystem::path file;  // empty: none
  std::chrono::milliseconds period{100};
  RetainPolicy policy = RetainPolicy::Carry;
  result::Location where;  // of `file`
};

struct BootSection {
  std::filesystem::path program;               // empty: none; the one that was kept comes before it
  std::vector<std::filesystem::path> sources;  // of `program`; empty: it is compiled elsewhere
  std::string dialect = "standard";            // of the sources (ladder/source/dialect.h)
  result::Location program_where;              // of `program`, where the file names it
  bool autostart = false;
  std::filesystem::path keep;  // where the last downloaded program is kept; empty: nowhere
};

// `folder` is that of the configuration file. A file that is not there is found out at the start, which does
// not need it.
void read_retain(const settings::TomlTable& root, const std::filesystem::path& folder,
                 const std::filesystem::path& state_dir, RetainSection& retain, BootSection& boot);

}  // namespace stepwright::config

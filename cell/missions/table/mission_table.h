#pragma once

// Table of a planner in a cell's file, read by the planner's own reader, with what the other processes of the
// cell have to know of it. No planner stands behind it: whoever loads a cell's file links none.
//
// Plain values, immutable once read; any thread.

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "ladder/source/dialect.h"
#include "runtime/ground/result/result.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::missions {

struct MissionTable {
  MissionTable() = default;
  MissionTable(const MissionTable&) = default;
  MissionTable& operator=(const MissionTable&) = default;
  virtual ~MissionTable() = default;

  // What hand-written programs, and sources that the page brings, may write beside the standard.
  virtual const source::Dialect& dialect() const { return source::standard_dialect(); }
  // Its programs tell of lost conditions by alarms of their own (supervisor/translate/monitors.h).
  virtual bool has_monitors() const { return false; }
  // Takes changed demands, the [[faults]] whose names begin with '(' (cell/config/cell_config.h).
  virtual bool takes_demands() const { return false; }
  // "KEY=VALUE" for a run that nobody can look after; for one of the same plan strictly in sequence (empty:
  // there is none).
  virtual std::vector<std::string> unattended() const { return {}; }
  virtual std::string in_sequence() const { return {}; }
};

// What a reader has to know of the rest of the file.
struct TablePlace {
  std::filesystem::path folder;  // of the file: relative paths are taken from there
  bool real_io = false;          // inputs and outputs are those of a real plant
};

// What is wrong is reported to the document of `table`.
using TableReader = std::shared_ptr<const MissionTable> (*)(const settings::TomlTable& table,
                                                            const TablePlace& place);

// The file that a key of the table names, from the folder of the cell's file; reported if there is none.
inline std::filesystem::path file_of(const settings::TomlTable& table, const char* key,
                                     const std::filesystem::path& folder, const std::string& text) {
  const std::filesystem::path path = folder / text;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    table.report(key, "there is no file " + path.string(), "paths are taken from the folder of this file");
  }
  return path;
}
// Empty where the key is missing, which is reported as well.
inline std::filesystem::path required_file(const settings::TomlTable& table, const char* key,
                                           const std::filesystem::path& folder) {
  const std::string text = table.required_text(key);
  return text.empty() ? std::filesystem::path() : file_of(table, key, folder, text);
}

// The planner's own table of a cell's, null if the cell has none of that planner.
template <typename Table>
const Table* table_as(const std::shared_ptr<const MissionTable>& table) {
  return dynamic_cast<const Table*>(table.get());
}

}  // namespace stepwright::missions

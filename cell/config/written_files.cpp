#include "cell/config/written_files.h"

#include <string>
#include <vector>

#include "cell/config/cell_config.h"
#include "runtime/bytecode/reader/container_file.h"
#include "runtime/ground/log/log_file.h"

namespace stepwright::config {
namespace {

namespace fs = std::filesystem;

struct NamedFile {
  std::string key;  // as people write it
  fs::path path;
  result::Location where;
};

// Links and the ways to a file make no difference.
bool is_same(const fs::path& one, const fs::path& other) {
  std::error_code error;
  if (fs::equivalent(one, other, error)) return true;
  return fs::absolute(one, error).lexically_normal() == fs::absolute(other, error).lexically_normal();
}

void add(std::vector<NamedFile>& files, const char* key, const fs::path& path, result::Location where = {}) {
  if (!path.empty()) files.push_back({key, path, std::move(where)});
}

std::vector<NamedFile> files_read(const CellConfig& config) {
  std::vector<NamedFile> files;
  add(files, "the cell's file", config.file);
  for (const fs::path& source : config.boot.sources) add(files, "[runtime] sources", source);
  if (config.boot.sources.empty()) add(files, "[runtime] program", config.boot.program);
  add(files, "[history] alarms", config.history.alarms);
  add(files, "[hmi] recipes", config.hmi.recipes);
  add(files, "[hmi] tags", config.hmi.tags);
  add(files, "[hmi] drawing", config.hmi.drawing);
  add(files, "[hmi] tls_certificate", config.hmi.certificate);
  add(files, "[hmi] tls_key", config.hmi.key);
  add(files, "[plant] file", config.plant.file);
  add(files, "[plant] file", config.plant.stepped.file);
  for (const fs::path& source : config.plant.stepped.sources) add(files, "[plant] sources", source);
  for (const MonitorConfig& monitor : config.monitors)
    add(files, "[[monitors]] formula_file", monitor.formula_file);
  return files;
}

std::vector<NamedFile> files_written(const CellConfig& config) {
  std::vector<NamedFile> files;
  if (!config.boot.sources.empty())
    add(files, "[runtime] program", config.boot.program, config.boot.program_where);
  add(files, "[retain] file", config.retain.file, config.retain.where);
  add(files, "[record] file", config.record.file, config.record.where);
  add(files, "[log] file", config.log.file, config.log.where);
  return files;
}

result::Diagnostic refusal(const NamedFile& written, const std::string& why, const char* hint) {
  return {"C0472", result::Severity::Error, written.where,
          written.key + " would overwrite " + written.path.string() + ", " + why, hint};
}

// A program that somebody names is replaced where it is one, or empty. The default is the cell's own.
bool replaces_no_program(const BootSection& boot) {
  if (boot.sources.empty() || boot.program_where.file.empty()) return false;
  std::error_code error;
  if (!fs::is_regular_file(boot.program, error)) return fs::exists(boot.program, error);
  return !reader::is_container_or_empty(boot.program);
}

// A log is appended to, and what it becomes too large for is renamed. Terminals, pipes and links are
// somebody's wish.
bool replaces_no_log(const log::LogConfig& log) {
  std::error_code error;
  return !log.file.empty() && fs::is_regular_file(log.file, error) && !log::is_log_or_empty(log.file);
}

}  // namespace

result::Diagnostics check_written_files(const CellConfig& config) {
  result::Diagnostics problems;
  std::vector<NamedFile> others = files_read(config);
  for (const NamedFile& written : files_written(config)) {
    for (const NamedFile& other : others) {
      if (!is_same(written.path, other.path)) continue;
      problems.push_back(refusal(written, "which is " + other.key, "name a file of its own"));
      break;
    }
    others.push_back(written);
  }
  if (problems.empty() && replaces_no_program(config.boot))
    problems.push_back(refusal({"[runtime] program", config.boot.program, config.boot.program_where},
                               "which is no compiled program",
                               "name a file of its own: it is made from [runtime] sources"));
  if (problems.empty() && replaces_no_log(config.log))
    problems.push_back(refusal({"[log] file", config.log.file, config.log.where}, "which is no log of a cell",
                               "name a file of its own"));
  return problems;
}

}  // namespace stepwright::config

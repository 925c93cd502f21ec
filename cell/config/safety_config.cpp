#include "cell/config/safety_config.h"

#include <algorithm>
#include <array>
#include <utility>

#include "cell/config/safe_rules.h"
#include "runtime/io_memory/io_area.h"

namespace stepwright::config {
namespace {

using settings::TomlTable;

// In the order of scan::SafeCause.
constexpr std::array kCauseTables = {"stop", "trap", "watchdog", "lost_io", "lost_supervisor", "killed"};
static_assert(kCauseTables.size() == scan::kSafeCauses);

constexpr double kLongestWatchdogUs = 600e6;
constexpr std::int64_t kNsPerUs = 1'000;
constexpr std::int64_t kNsPerMs = 1'000'000;

// The rules of one cause: its own, and those for every cause that they leave.
host::SafeTable::Column column_of(const std::vector<SafeRule>& all, const std::vector<SafeRule>& own,
                                  result::Diagnostics& problems) {
  std::vector<const SafeRule*> rules;
  for (const SafeRule& rule : all) {
    const bool replaced = std::ranges::any_of(own, [&](const SafeRule& other) { return other.covers(rule); });
    if (replaced) continue;
    const auto cut = std::ranges::find_if(own, [&](const SafeRule& other) { return other.overlaps(rule); });
    if (cut != own.end() && rule.ramp) {
      problems.push_back({"C0445", result::Severity::Error, cut->where,
                          cut->address + " is a part of " + rule.address + ", which has a ramp",
                          "give " + rule.address + " a rule for this cause, too"});
    }
    rules.push_back(&rule);
  }
  for (const SafeRule& rule : own) rules.push_back(&rule);
  host::SafeTable::Column column;
  for (const SafeRule* rule : rules) {
    column.outputs.insert(column.outputs.end(), rule->outputs.begin(), rule->outputs.end());
    if (!rule->ramp) continue;
    column.ramps.push_back(*rule->ramp);
    const bool told =
        !problems.empty() && problems.back().where.line == rule->where.line;  // for another cause
    if (column.ramps.size() == scan::kMaxRamps + 1 && !told) {
      problems.push_back({"C0445", result::Severity::Error, rule->where,
                          "there are more than " + std::to_string(scan::kMaxRamps) + " ramps for a cause",
                          ""});
    }
  }
  return column;
}

void read_safe_states(const TomlTable& table, std::uint32_t output_bytes, host::SafeTable& safe,
                      result::Diagnostics& problems) {
  const std::vector<SafeRule> all = read_safe_rules(table.table("outputs"), output_bytes, problems);
  for (std::size_t i = 0; i < kCauseTables.size(); ++i) {
    const std::vector<SafeRule> own = read_safe_rules(table.table(kCauseTables[i]), output_bytes, problems);
    safe.columns[i] = column_of(all, own, problems);
  }
}

scan::WatchdogLimits read_limits(const TomlTable& table, const char* time_key, const char* sensitivity_key,
                                 const scan::WatchdogLimits& fallback) {
  const std::int64_t time_us = table.integer(time_key, fallback.time_ns / kNsPerUs, {0, kLongestWatchdogUs});
  const std::int64_t sensitivity = table.integer(sensitivity_key, fallback.sensitivity, {0, 1'000});
  return {time_us * kNsPerUs, static_cast<std::uint32_t>(sensitivity)};
}

void read_watchdogs(const TomlTable& root, host::SafetyConfig& safety) {
  safety.watchdog = read_limits(root.table("watchdog"), "time_us", "sensitivity", safety.watchdog);
  const TomlTable tasks = root.table("tasks");
  for (const std::string& task : tasks.keys()) {
    if (!tasks.has_table(task)) continue;  // whoever reads the rest of the table reports it
    safety.watchdogs.push_back(
        {task, read_limits(tasks.table(task), "watchdog_us", "watchdog_sensitivity", safety.watchdog)});
  }
}

void read_io(const TomlTable& root, SafetyConfig& safety, result::Diagnostics& problems) {
  const TomlTable io = root.table("io");
  const std::string kind = io.choice("kind", "plant", {"plant", "shared_memory", "modbus"});
  safety.io.modbus = kind == "modbus";
  safety.io.shared_memory = safety.io.modbus || kind == "shared_memory";
  safety.io.name = io.text("name", root.table("cell").text("name", "cell"));
  safety.io.restart = read_restart(io, safety.io.shared_memory, problems);
  const TomlTable guard = root.table("guard");
  // What moves in the field goes on moving when the runtime is killed.
  safety.guard.enabled = guard.boolean("enabled", safety.io.modbus);
  safety.guard.timeout =
      std::chrono::milliseconds(guard.integer("timeout_ms", safety.guard.timeout.count(), {10, 60'000}));
  const auto fail = [&](const char* code, result::Location where, std::string message, std::string hint) {
    problems.push_back(
        {code, result::Severity::Error, std::move(where), std::move(message), std::move(hint)});
  };
  if (kind == "shared_memory" && root.table("clock").text("mode", "simulated") != "real") {
    fail("C0446", io.where("kind"),
         "a plant in shared memory goes by its own clock, and this cell's is simulated",
         "[clock] mode = \"real\"");
  }
  if (safety.io.shared_memory && !io_memory::is_area_name(safety.io.name)) {
    fail("C0447", io.where("name"), "'" + safety.io.name + "' is no name for a shared-memory area",
         "letters, digits, '-', '_' and '.', 64 of them at most");
  }
  if (safety.guard.enabled && !safety.io.shared_memory) {
    fail("C0446", guard.where("enabled"), "a guard can drive outputs in shared memory only",
         "[io] kind = \"shared_memory\"; the simulated plant of [plant] ends with its runtime");
  }
}

// The monitor looks often enough for the shortest watchdog and for the guard.
void set_monitor(SafetyConfig& safety) {
  host::SafetyConfig& host = safety.host;
  const auto consider = [&](const scan::WatchdogLimits& limits) {
    if (limits.time_ns > 0) host.monitor_ns = std::min(host.monitor_ns, limits.time_ns / 4);
  };
  consider(host.watchdog);
  for (const host::NamedWatchdog& named : host.watchdogs) consider(named.limits);
  if (safety.io.shared_memory) {
    const std::int64_t timeout_ns = safety.guard.timeout.count() * kNsPerMs;
    host.monitor_ns = std::min(host.monitor_ns, timeout_ns / 5);
    host.stall_ns = timeout_ns / 2;
  }
  host.monitor_ns = std::max(host.monitor_ns, kNsPerMs);
}

}  // namespace

result::Diagnostics read_safety(const TomlTable& root, std::uint32_t output_bytes, SafetyConfig& safety) {
  result::Diagnostics problems;
  read_safe_states(root.table("safe_state"), output_bytes, safety.host.safe_state, problems);
  read_watchdogs(root, safety.host);
  read_io(root, safety, problems);
  set_monitor(safety);
  return problems;
}

}  // namespace stepwright::config

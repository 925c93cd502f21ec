#include "cell/config/monitor_config.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {
namespace {

using settings::TomlTable;

constexpr std::size_t kMostBytes = 48;  // of a name, which is a part of others

// Letters, digits and single underscores, as IEC 61131-3 has it.
bool is_identifier(std::string_view name) {
  const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && name.size() <= kMostBytes &&
         std::isdigit(static_cast<unsigned char>(name[0])) == 0 && std::ranges::all_of(name, fits) &&
         name.find("__") == std::string_view::npos && name.back() != '_';
}

// What could end the line that it becomes, or the statement.
bool is_one_expression(std::string_view text) {
  return text.find_first_not_of(' ') != std::string_view::npos &&
         text.find_first_of(";\n\r") == std::string_view::npos && text.find("(*") == std::string_view::npos &&
         text.find("//") == std::string_view::npos && text.find(":=") == std::string_view::npos;
}

void read_meanings(const TomlTable& table, MonitorConfig& monitor) {
  for (const std::string& name : table.keys()) {
    PropositionMeaning meaning{name, table.text(name, {}), table.where(name)};
    if (!is_one_expression(meaning.expression)) {
      table.report(name, "this says not what '" + name + "' means", "one expression: \"main.level >= 20\"",
                   "0555");
      continue;
    }
    monitor.let.push_back(std::move(meaning));
  }
}

void read_actions(const TomlTable& table, MonitorConfig& monitor) {
  if (!table.has("on_false")) return;
  monitor.alarm = false;
  for (const std::string& action : table.texts("on_false")) {
    if (action == "alarm") {
      monitor.alarm = true;
    } else if (action == "safe_state") {
      monitor.safe_state = true;
    } else if (action == "event") {
      monitor.event = true;
    } else {
      table.report("on_false", "nothing is called '" + action + "' that could happen",
                   "on_false is a list of \"alarm\", \"safe_state\" and \"event\"", "0554");
    }
  }
}

}  // namespace

std::vector<MonitorConfig> read_monitors(const TomlTable& root, const std::filesystem::path& folder) {
  std::vector<MonitorConfig> monitors;
  for (const TomlTable& table : root.tables("monitors")) {
    MonitorConfig monitor;
    monitor.name = table.required_text("name", "0551");
    monitor.formula = table.text("formula", {});
    const std::string file = table.text("formula_file", {});
    if (!file.empty()) monitor.formula_file = folder / file;
    monitor.where = table.where(file.empty() ? "formula" : "formula_file");
    read_meanings(table.table("let"), monitor);
    read_actions(table, monitor);
    const bool known = std::ranges::any_of(
        monitors, [&](const auto& other) { return naming::same_name(other.name, monitor.name); });
    const bool two = table.has("formula") && table.has("formula_file");
    if (!monitor.name.empty() && !is_identifier(monitor.name)) {
      table.report("name", "'" + monitor.name + "' cannot name a monitor",
                   "at most 48 letters, digits and single underscores, no digit first", "0551");
    } else if (known) {
      table.report("name", "there is another monitor '" + monitor.name + "'", "", "0552");
    } else if (two || (monitor.formula.empty() && file.empty())) {
      table.report(two ? "formula_file" : "formula",
                   two ? "this monitor has two formulas" : "this monitor has no formula",
                   "formula = \"never wash before press\", or formula_file = \"rules.ltl\"", "0553");
    } else if (!monitor.name.empty()) {
      monitors.push_back(std::move(monitor));
    }
  }
  return monitors;
}

}  // namespace stepwright::config

#include "hmi_web/alarms/definition_file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "runtime/base/time_text.h"

namespace stepwright::alarms {
namespace {

using settings::TomlTable;

constexpr std::array<const char*, kPriorities> kPriorityNames = {"critical", "high", "medium", "low"};
constexpr std::array kKindNames = {"high", "low", "on", "off", "bad"};
// Of the page, beside that of the definitions themselves.
constexpr std::array kLanguages = {"de", "en", "es", "fr"};
constexpr double kLongestDelayS = 86'400.0;
constexpr double kLongestShelvingMin = 7 * 24 * 60.0;

template <typename Names>
std::vector<std::string> list(const Names& names) {
  return {names.begin(), names.end()};
}

template <typename Enum, typename Names>
Enum read_choice(const TomlTable& table, const char* key, Enum fallback, const Names& names) {
  const std::string word = table.choice(key, names[static_cast<std::size_t>(fallback)], list(names));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (word == names[i]) return static_cast<Enum>(i);
  return fallback;
}

std::chrono::nanoseconds read_duration(const TomlTable& table, const char* key, std::chrono::nanoseconds unit,
                                       std::chrono::nanoseconds fallback, double most) {
  const double count = static_cast<double>(unit.count());
  const double value = table.number(key, static_cast<double>(fallback.count()) / count, {0.0, most});
  return std::chrono::nanoseconds(static_cast<std::int64_t>(value * count));
}

// A number, or a duration of IEC 61131-3, which is one of seconds: "T#1m30s".
double read_quantity(const TomlTable& table, const char* key, settings::Range range = {}) {
  if (!table.is_text(key)) return table.number(key, 0.0, range);
  const std::string text = table.text(key, "");
  std::int64_t ns = 0;
  if (!base::parse_time(text, ns)) {
    table.report(key, "'" + text + "' is neither a number nor a duration",
                 std::string(key) + " = 9.5, or " + key + " = \"T#1m30s\" of a TIME", "0003");
    return 0.0;
  }
  const double seconds = static_cast<double>(ns) / 1e9;
  if (seconds < range.low)
    table.report(key, "'" + text + "' is below 0", std::string(key) + " = \"T#1s\"", "0004");
  return seconds;
}

ConditionSettings read_condition(const TomlTable& table) {
  ConditionSettings made;
  made.kind = read_choice(table, "when", ConditionKind::On, kKindNames);
  const bool has_limit = made.kind == ConditionKind::High || made.kind == ConditionKind::Low;
  made.limit = read_quantity(table, "limit");
  made.deadband = read_quantity(table, "deadband", {0.0, 1e300});
  if (has_limit && !table.has("limit"))
    table.report("when",
                 std::string("an alarm that watches for '") + to_string(made.kind) + "' needs a limit",
                 "limit = 9.5", "0602");
  for (const char* key : {"limit", "deadband"}) {
    if (!has_limit && table.has(key))
      table.report(key, std::string("an alarm that watches for '") + to_string(made.kind) + "' has no " + key,
                   "when = \"high\" or \"low\" has one", "0603");
  }
  using std::chrono::seconds;
  made.on_delay = read_duration(table, "on_delay_s", seconds(1), seconds(0), kLongestDelayS);
  made.off_delay = read_duration(table, "off_delay_s", seconds(1), seconds(0), kLongestDelayS);
  return made;
}

AlarmDefinition read_alarm(const TomlTable& table) {
  AlarmDefinition made;
  made.where = table.where();
  made.source_where = table.where("source");
  made.suppress_when_where = table.where("suppress_when");
  made.name = table.required_text("name", "0602");
  made.source = table.required_text("source", "0602");
  made.text = table.text("text", made.name);
  made.condition = read_condition(table);
  made.priority = read_choice(table, "priority", Priority::Medium, kPriorityNames);
  made.traits.latching = table.boolean("latching", false);
  made.traits.acknowledge_on_return =
      table.choice("acknowledge", "operator", {"operator", "on_return"}) == "on_return";
  made.group = table.text("group", "");
  made.suppress_when = table.text("suppress_when", "");
  made.suppress_by_hand = table.boolean("suppress_by_hand", false);
  if (made.suppress_by_hand && !made.suppress_when.empty())
    table.report("suppress_by_hand", "a variable suppresses this alarm already",
                 "leave out suppress_by_hand or suppress_when", "0603");
  made.longest_shelving = read_duration(table, "shelve_at_most_min", std::chrono::minutes(1),
                                        made.longest_shelving, kLongestShelvingMin);
  made.consequence = table.text("consequence", "");
  made.response = table.text("response", "");
  for (const char* language : kLanguages) {
    if (!table.has_table(language)) continue;
    const TomlTable words = table.table(language);
    made.words[language] = {words.text("text", ""), words.text("consequence", ""),
                            words.text("response", "")};
  }
  return made;
}

}  // namespace

const char* to_string(Priority priority) {
  return kPriorityNames[static_cast<std::size_t>(priority)];
}
const char* to_string(ConditionKind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}

std::vector<AlarmDefinition> read_alarms(const TomlTable& root) {
  std::vector<AlarmDefinition> made;
  std::map<std::string, std::uint32_t> lines;
  for (const TomlTable& table : root.tables("alarm")) {
    made.push_back(read_alarm(table));
    const auto [first, fresh] = lines.emplace(made.back().name, table.where("name").line);
    if (!fresh && !made.back().name.empty())
      table.report("name", "there are two alarms '" + made.back().name + "'",
                   "the other one is in line " + std::to_string(first->second), "0601");
  }
  return made;
}

result::Result<std::vector<AlarmDefinition>> load_alarms(const std::filesystem::path& file) {
  auto document = settings::TomlDocument::load(file);
  if (!document) return result::forward(document);
  std::vector<AlarmDefinition> made = read_alarms((*document)->root());
  result::Diagnostics problems = (*document)->finish();
  if (result::has_errors(problems)) return tl::unexpected<result::Diagnostics>(std::move(problems));
  return made;
}

}  // namespace stepwright::alarms

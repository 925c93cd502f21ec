#include "cell/config/reload.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace stepwright::config {
namespace {

using settings::SettingText;

bool matches(const std::string& key, std::string_view pattern) {
  return pattern.ends_with('.') ? key.starts_with(pattern) : key == pattern;
}

const SettingText* find(const settings::SettingTexts& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? nullptr : &found->second;
}

}  // namespace

result::Result<ReloadedCell> reload_cell(const CellConfig& running,
                                         const std::vector<std::string_view>& reloadable) {
  auto wanted = load_cell_config(running.file, running.overrides);
  if (!wanted) return result::forward(wanted);
  ReloadedCell again{running, std::move(*wanted), {}};
  const auto takes = [&](const std::string& key) {
    return std::any_of(reloadable.begin(), reloadable.end(),
                       [&](std::string_view pattern) { return matches(key, pattern); });
  };
  std::set<std::string> keys;
  for (const auto& [key, value] : running.values) keys.insert(key);
  for (const auto& [key, value] : again.wanted.values) keys.insert(key);
  for (const std::string& key : keys) {
    const SettingText* before = find(running.values, key);
    const SettingText* after = find(again.wanted.values, key);
    if (before != nullptr && after != nullptr && before->text == after->text) continue;
    const result::Location where =
        after != nullptr ? after->where : result::Location{running.file.string(), 0, 0};
    const std::string now = after != nullptr ? "is " + after->text : "is left out";
    if (!takes(key)) {
      again.notes.push_back({"C0465", result::Severity::Warning, where, "'" + key + "' " + now + " now",
                             "this needs a restart; until then the old value holds"});
      continue;
    }
    again.notes.push_back(
        {"C0464", result::Severity::Note, where, "'" + key + "' " + now + " from now on", {}});
    if (after != nullptr) {
      again.config.values[key] = *after;
    } else {
      again.config.values.erase(key);
    }
  }
  if (takes("log.level")) again.config.log = again.wanted.log;
  if (takes("safe_state.supervisor_lost_after_ms")) {
    again.config.supervisor_lost_after = again.wanted.supervisor_lost_after;
  }
  return again;
}

}  // namespace stepwright::config

// Every value of a document as text (TomlDocument::values).

#include <sstream>
#include <string>

#include "runtime/ground/settings/toml_state.h"

namespace stepwright::settings {
namespace {

// Words that differ where the values differ; nobody reads them as TOML.
std::string scalar_text(const toml::node& node) {
  std::ostringstream text;
  text.precision(17);
  if (const auto words = node.value_exact<std::string>()) {
    text << '"' << *words << '"';
  } else if (const auto whole = node.value_exact<std::int64_t>()) {
    text << *whole;
  } else if (const auto number = node.value_exact<double>()) {
    text << *number;
  } else if (const auto truth = node.value_exact<bool>()) {
    text << (*truth ? "true" : "false");
  } else if (const auto date = node.value_exact<toml::date>()) {
    text << *date;
  } else if (const auto time = node.value_exact<toml::time>()) {
    text << *time;
  } else if (const auto instant = node.value_exact<toml::date_time>()) {
    text << *instant;
  }
  return text.str();
}

template <typename Place>
void collect(const toml::node& node, const std::string& path, const Place& place, SettingTexts& texts) {
  if (const toml::table* table = node.as_table()) {
    const std::string prefix = path.empty() ? "" : path + ".";
    for (const auto& [key, value] : *table) collect(value, prefix + std::string(key.str()), place, texts);
  } else if (const toml::array* array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) {
      collect(*array->get(i), path + "[" + std::to_string(i) + "]", place, texts);
    }
  } else {
    texts[path] = {scalar_text(node), place(path, node.source())};
  }
}

}  // namespace

SettingTexts TomlDocument::values() const {
  SettingTexts texts;
  collect(
      state_->root, "",
      [this](const std::string& path, const toml::source_region& source) {
        return state_->place(path, source);
      },
      texts);
  return texts;
}

}  // namespace stepwright::settings

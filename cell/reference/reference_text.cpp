#include <nlohmann/json.hpp>

#include "cell/reference/key_reference.h"

namespace stepwright::reference {
namespace {

std::string heading_of(const TableEntry& table) {
  if (table.name.empty()) return "The file";
  return table.array ? "`[[" + table.name + "]]`" : "`[" + table.name + "]`";
}

// A cell of a table of Markdown.
std::string cell_of(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.insert(at, "\\");
  return text;
}

std::string values_of(const KeyEntry& key) {
  std::string kind = key.range.empty() ? key.type : key.range;
  if (!key.range.empty() && key.type == "whole number") kind = "whole, " + kind;
  if (!key.range.empty() && key.type == "list of texts") kind = "list: " + kind;
  return key.unit.empty() || key.unit == "1" ? kind : kind + (kind.empty() ? "" : "; ") + key.unit;
}

}  // namespace

std::string markdown_of(const KeyReference& reference) {
  std::string text =
      "# " + reference.title +
      "\n\nMade by `stepwright reference` from the code that reads the file; not written by hand. " +
      reference.about + "\n";
  for (const TableEntry& table : reference.tables) {
    text += "\n## " + heading_of(table) + "\n" + table.text + "\n";
    if (table.keys.empty()) continue;
    text += "\n| key | values; unit | default | |\n|---|---|---|---|\n";
    for (const KeyEntry& key : table.keys)
      text += "| `" + key.key + "` | " + cell_of(values_of(key)) + " | " + cell_of(key.otherwise) + " | " +
              cell_of(key.text) + " |\n";
  }
  return text;
}

std::string json_of(const KeyReference& reference) {
  nlohmann::ordered_json tables = nlohmann::ordered_json::array();
  for (const TableEntry& table : reference.tables) {
    nlohmann::ordered_json keys = nlohmann::ordered_json::array();
    for (const KeyEntry& key : table.keys) {
      keys.push_back({{"key", key.key},
                      {"type", key.type},
                      {"unit", key.unit},
                      {"default", key.otherwise},
                      {"range", key.range},
                      {"text", key.text}});
    }
    tables.push_back({{"name", table.name}, {"array", table.array}, {"text", table.text}, {"keys", keys}});
  }
  return nlohmann::ordered_json{{"tables", tables}}.dump(1) + "\n";
}

}  // namespace stepwright::reference

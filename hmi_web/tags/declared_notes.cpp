#include "hmi_web/tags/declared_notes.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/protocol/program_document.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::tags {
namespace {

using naming::upper;
using nlohmann::json;

std::string text_of(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// In one line.
std::string flat(const std::string& comment) {
  std::string line;
  for (const char c : comment) {
    const bool space = c == ' ' || c == '\n' || c == '\r' || c == '\t';
    if (!space) line += c;
    if (space && !line.empty() && line.back() != ' ') line += ' ';
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

// Nothing of what is too long to be read.
std::string short_text(const json& object, const char* key) {
  std::string text = flat(text_of(object, key));
  return text.size() > kMostNoteBytes ? std::string() : text;
}

std::optional<int> decimals_of(const json& note) {
  const auto found = note.find("decimals");
  if (found == note.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() > 9)
    return std::nullopt;
  return found->get<int>();
}

std::optional<std::pair<double, double>> range_of(const json& note) {
  const auto found = note.find("range");
  if (found == note.end() || !found->is_array() || found->size() != 2) return std::nullopt;
  const json& least = (*found)[0];
  const json& greatest = (*found)[1];
  if (!least.is_number() || !greatest.is_number()) return std::nullopt;
  const std::pair ends(least.get<double>(), greatest.get<double>());
  const bool sound = std::isfinite(ends.first) && std::isfinite(ends.second) && ends.first < ends.second;
  return sound ? std::optional(ends) : std::nullopt;
}

std::vector<std::string> values_of(const json& note) {
  const auto found = note.find("values");
  if (found == note.end() || !found->is_array() || found->size() > kMostNamedValues) return {};
  std::vector<std::string> names;
  for (const json& each : *found) {
    if (!each.is_string() || each.get_ref<const std::string&>().size() > kMostNoteBytes) return {};
    names.push_back(each.get<std::string>());
  }
  return names;
}

// Of a declaration; without a name.
protocol::TagNote note_of(const json& variable) {
  protocol::TagNote note;
  const auto said = variable.find("note");
  if (said != variable.end() && said->is_object()) {
    note.unit = short_text(*said, "unit");
    note.description = short_text(*said, "description");
    note.group = short_text(*said, "group");
    note.decimals = decimals_of(*said);
    note.normal = range_of(*said);
    note.values = values_of(*said);
  }
  if (note.description.empty()) note.description = short_text(variable, "comment");
  return note;
}

bool has_instances(const std::string& kind) {
  return kind == "PROGRAM" || kind == "FUNCTION_BLOCK";
}

}  // namespace

DeclaredNotes::DeclaredNotes(std::span<const reader::InstanceInfo> instances, std::string_view document) {
  if (document.empty()) return;
  const json parsed = protocol::parsed_document(document);
  if (parsed.is_null()) return;
  for (const reader::InstanceInfo& each : instances) pous_.emplace(upper(each.path), upper(each.pou));
  for (const json& sheet : parsed["sheets"]) {
    if (!sheet.is_object() || !sheet.contains("variables") || !sheet["variables"].is_array()) continue;
    const std::string kind = text_of(sheet, "kind");
    const bool global = kind == "VAR_GLOBAL" || kind == "CONFIGURATION";
    if (!global && !has_instances(kind)) continue;
    const std::string owner = global ? std::string() : upper(text_of(sheet, "name"));
    for (const json& variable : sheet["variables"]) {
      if (!variable.is_object()) continue;
      protocol::TagNote note = note_of(variable);
      if (!note.says_nothing())
        notes_.emplace(owner + "." + upper(text_of(variable, "name")), std::move(note));
    }
  }
}

protocol::TagNote DeclaredNotes::of(std::string_view tag) const {
  if (notes_.empty()) return {};
  // Indices of an element, the last of the name.
  while (tag.ends_with(']') && tag.find('[') != std::string_view::npos) tag = tag.substr(0, tag.rfind('['));
  const auto dot = tag.rfind('.');
  const std::string path = dot == std::string_view::npos ? std::string() : upper(tag.substr(0, dot));
  const std::string name = upper(dot == std::string_view::npos ? tag : tag.substr(dot + 1));
  std::string owner;
  if (!path.empty()) {
    const auto pou = pous_.find(path);
    if (pou == pous_.end()) return {};
    owner = pou->second;
  }
  const auto found = notes_.find(owner + "." + name);
  return found == notes_.end() ? protocol::TagNote() : found->second;
}

}  // namespace stepwright::tags

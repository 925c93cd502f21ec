#include "hmi_web/server/declared_comments.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "hmi_web/protocol/program_document.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::server {
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

bool has_instances(const std::string& kind) {
  return kind == "PROGRAM" || kind == "FUNCTION_BLOCK";
}

}  // namespace

DeclaredComments::DeclaredComments(std::span<const reader::InstanceInfo> instances,
                                   std::string_view document) {
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
      std::string comment = flat(text_of(variable, "comment"));
      if (comment.empty() || comment.size() > kMostCommentBytes) continue;
      comments_.emplace(owner + "." + upper(text_of(variable, "name")), std::move(comment));
    }
  }
}

std::string DeclaredComments::of(std::string_view tag) const {
  if (comments_.empty()) return {};
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
  const auto found = comments_.find(owner + "." + name);
  return found == comments_.end() ? std::string() : found->second;
}

}  // namespace stepwright::server

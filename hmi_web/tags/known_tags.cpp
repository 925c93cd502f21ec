#include "hmi_web/tags/known_tags.h"

#include <utility>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::tags {

std::string without_indices(std::string_view name) {
  std::string plain;
  int brackets = 0;
  for (const char c : name) {
    if (c == '[') ++brackets;
    if (brackets == 0) plain += c;
    if (c == ']' && brackets > 0) --brackets;
  }
  return plain;
}

KnownTags::KnownTags(std::vector<protocol::TagNote> said, DeclaredNotes declared)
    : declared_(std::move(declared)) {
  for (protocol::TagNote& each : said) said_.emplace(naming::upper(each.name), std::move(each));
}

protocol::TagNote KnownTags::of(std::string_view tag) const {
  protocol::TagNote known = declared_.of(tag);
  const std::string key = naming::upper(tag);
  auto said = said_.find(key);
  if (said == said_.end()) said = said_.find(without_indices(key));
  if (said != said_.end()) {
    const protocol::TagNote& cell = said->second;
    if (!cell.unit.empty()) known.unit = cell.unit;
    if (!cell.description.empty()) known.description = cell.description;
    if (!cell.group.empty()) known.group = cell.group;
    if (cell.decimals) known.decimals = cell.decimals;
    if (cell.normal) known.normal = cell.normal;
    if (!cell.values.empty()) known.values = cell.values;
  }
  known.name = tag;
  return known;
}

}  // namespace stepwright::tags

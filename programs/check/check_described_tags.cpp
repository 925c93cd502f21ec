#include "programs/check/check_described_tags.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::check {
namespace {

// "main.levels" of "Main.levels[3]".
std::string without_indices(const std::string& name) {
  std::string rest;
  bool inside = false;
  for (const char c : name) {
    if (c == '[') inside = true;
    if (!inside) rest += c;
    if (c == ']') inside = false;
  }
  return rest;
}

}  // namespace

result::Diagnostics check_described_tags(std::span<const config::TagConfig> tags,
                                         const reader::ProgramInfo& info,
                                         const std::vector<std::string>& points) {
  if (tags.empty()) return {};
  std::set<std::string> known;
  std::vector<std::string> names;
  for (const reader::Tag& tag : info.tags()) {
    known.insert(naming::upper(tag.name));
    known.insert(naming::upper(without_indices(tag.name)));
    names.push_back(tag.name);
  }
  for (const std::string& point : points) {
    known.insert(naming::upper(point));
    names.push_back(point);
  }
  result::Diagnostics problems;
  for (const config::TagConfig& tag : tags) {
    if (known.contains(naming::upper(tag.name))) continue;
    const std::string meant = settings::closest(tag.name, names);
    problems.push_back(
        {"C0632", result::Severity::Warning, tag.where,
         "neither the program nor the plant has '" + tag.name + "'",
         meant.empty() ? "a name as `stepwright snapshot` writes it" : "did you mean '" + meant + "'?"});
  }
  return problems;
}

}  // namespace stepwright::check

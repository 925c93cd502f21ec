#include "cell/check/check_described_tags.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "runtime/bytecode/value_type.h"
#include "runtime/bytecode/whole_number.h"
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

// Why names of values mean nothing for a type; empty: they do.
std::string misnamed(const config::TagConfig& tag, bytecode::ElementaryType type) {
  if (tag.values.empty()) return "";
  if (type == bytecode::ElementaryType::Bool)
    return tag.values.size() > 2
               ? "a BOOL has two values, and " + std::to_string(tag.values.size()) + " names here"
               : "";
  return bytecode::is_whole_number(type) ? ""
                                         : "only BOOL and whole numbers have names of values, this is a " +
                                               std::string(bytecode::name_of(type));
}

}  // namespace

result::Diagnostics check_described_tags(std::span<const config::TagConfig> tags,
                                         const reader::ProgramInfo& info,
                                         const std::vector<std::string>& points) {
  if (tags.empty()) return {};
  using Type = std::optional<bytecode::ElementaryType>;  // a point has none
  std::map<std::string, Type> known;
  std::vector<std::string> names;
  for (const reader::Tag& tag : info.tags()) {
    known.emplace(naming::upper(tag.name), tag.variable.type);
    known.emplace(naming::upper(without_indices(tag.name)), tag.variable.type);
    names.push_back(tag.name);
  }
  for (const std::string& point : points) {
    known.emplace(naming::upper(point), std::nullopt);
    names.push_back(point);
  }
  result::Diagnostics problems;
  for (const config::TagConfig& tag : tags) {
    if (const auto found = known.find(naming::upper(tag.name)); found != known.end()) {
      const std::string why = found->second ? misnamed(tag, *found->second) : "";
      if (!why.empty())
        problems.push_back({"C0637", result::Severity::Warning, tag.where,
                            "the values of '" + tag.name + "' are not shown: " + why, ""});
      continue;
    }
    const std::string meant = settings::closest(tag.name, names);
    problems.push_back(
        {"C0632", result::Severity::Warning, tag.where,
         "neither the program nor the plant has '" + tag.name + "'",
         meant.empty() ? "a name as `stepwright snapshot` writes it" : "did you mean '" + meant + "'?"});
  }
  return problems;
}

}  // namespace stepwright::check

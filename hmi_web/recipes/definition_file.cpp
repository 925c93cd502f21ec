#include "hmi_web/recipes/definition_file.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::recipes {
namespace {

using bytecode::ElementaryType;
using settings::TomlTable;

// Characters and dates have no range that a person could set.
constexpr std::array kTypes = {ElementaryType::Bool,  ElementaryType::Sint,   ElementaryType::Int,
                               ElementaryType::Dint,  ElementaryType::Lint,   ElementaryType::Usint,
                               ElementaryType::Uint,  ElementaryType::Udint,  ElementaryType::Ulint,
                               ElementaryType::Byte,  ElementaryType::Word,   ElementaryType::Dword,
                               ElementaryType::Lword, ElementaryType::Real,   ElementaryType::Lreal,
                               ElementaryType::Time,  ElementaryType::String, ElementaryType::Wstring};

std::vector<std::string> type_names() {
  std::vector<std::string> names;
  for (const ElementaryType type : kTypes) names.emplace_back(bytecode::name_of(type));
  return names;
}

ElementaryType read_type(const TomlTable& table) {
  if (table.required_text("type").empty()) return ElementaryType::Bool;
  const std::string word = table.choice("type", "BOOL", type_names());
  for (const ElementaryType type : kTypes)
    if (word == bytecode::name_of(type)) return type;
  return ElementaryType::Bool;
}

// What the type itself can hold; of a TIME in seconds.
std::pair<double, double> reach_of(ElementaryType type) {
  if (type == ElementaryType::Lreal) return {-1.7976931348623157e308, 1.7976931348623157e308};
  if (type == ElementaryType::Real) return {-3.4028234663852886e38, 3.4028234663852886e38};
  if (type == ElementaryType::Time) return {-9.2e9, 9.2e9};
  const int bits = static_cast<int>(8 * bytecode::size_of(bytecode::mem_type(type)));
  if (bytecode::is_unsigned(type)) return {0, std::ldexp(1.0, bits) - 1};
  return {-std::ldexp(1.0, bits - 1), std::ldexp(1.0, bits - 1) - 1};
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

void read_range(const TomlTable& table, RecipeTag& tag) {
  if (!has_range(tag.type)) {
    // Asked for, so that they are told once and not as unknown keys, too.
    (void)table.number("min", 0);
    (void)table.number("max", 0);
    (void)table.text("unit", "");
    for (const char* key : {"min", "max", "unit"}) {
      if (table.has(key))
        table.report(key, std::string("a ") + bytecode::name_of(tag.type) + " has no " + key,
                     "leave it out, or give the type", "0622");
    }
    return;
  }
  tag.least = table.required_number("min");
  tag.most = table.required_number("max");
  tag.unit = table.text("unit", tag.type == ElementaryType::Time ? "s" : "");
  if (!table.has("min") || !table.has("max")) return;
  if (!(tag.least <= tag.most))
    table.report("max", "max is below min, so that no value fits", "min <= max", "0621");
  const auto [lowest, highest] = reach_of(tag.type);
  for (const auto& [key, value] : {std::pair("min", tag.least), std::pair("max", tag.most)}) {
    if (!(value >= lowest && value <= highest))
      table.report(key, std::string("a ") + bytecode::name_of(tag.type) + " cannot be that",
                   "from " + short_number(lowest) + " to " + short_number(highest), "0621");
  }
}

RecipeTag read_tag(const TomlTable& table) {
  RecipeTag tag;
  tag.where = table.where();
  tag.name_where = table.where("name");
  tag.name = table.required_text("name", "0620");
  tag.type = read_type(table);
  read_range(table, tag);
  tag.comment = table.text("comment", "");
  if (tag.name.size() > kLongestTag)
    table.report("name", "this cannot be the name of a tag", "name = \"mixer.level\" or \"%IW1\"", "0620");
  return tag;
}

}  // namespace

std::vector<RecipeTag> read_definitions(const TomlTable& root) {
  std::vector<RecipeTag> made;
  std::map<std::string, std::uint32_t> lines;
  for (const TomlTable& table : root.tables("tag")) {
    made.push_back(read_tag(table));
    const auto [first, fresh] = lines.emplace(naming::upper(made.back().name), table.where("name").line);
    if (!fresh && !made.back().name.empty())
      table.report("name", "the tag '" + made.back().name + "' is there twice",
                   "the other one is in line " + std::to_string(first->second), "0620");
  }
  if (made.empty()) root.report("tag", "there is no tag that a recipe could set", "[[tag]]", "0620");
  if (made.size() > kMostTags)
    root.report("tag", "there are " + std::to_string(made.size()) + " tags",
                "at most " + std::to_string(kMostTags), "0620");
  return made;
}

result::Result<std::vector<RecipeTag>> load_definitions(const std::filesystem::path& file) {
  auto document = settings::TomlDocument::load(file);
  if (!document) return result::forward(document);
  std::vector<RecipeTag> made = read_definitions((*document)->root());
  result::Diagnostics problems = (*document)->finish();
  if (result::has_errors(problems)) return tl::unexpected<result::Diagnostics>(std::move(problems));
  return made;
}

}  // namespace stepwright::recipes

#include "cell/config/tag_config.h"

#include <algorithm>
#include <cmath>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::config {
namespace {

using settings::TomlTable;

constexpr double kMostDecimals = 9;

std::optional<settings::Range> read_range(const TomlTable& table) {
  if (!table.has("range")) return std::nullopt;
  const std::vector<double> ends = table.numbers("range");
  const bool finite = std::ranges::all_of(ends, [](double each) { return std::isfinite(each); });
  if (finite && ends.size() == 2 && ends[0] < ends[1]) return settings::Range{ends[0], ends[1]};
  table.report("range", "this range has nothing in it", "the least and the greatest normal value: [0, 200]",
               "0631");
  return std::nullopt;
}

TagConfig read_tag(const TomlTable& table, const std::string& name) {
  TagConfig tag;
  tag.name = name;
  tag.unit = table.text("unit", {});
  tag.description = table.text("description", {});
  tag.group = table.text("group", {});
  if (table.has("decimals"))
    tag.decimals = static_cast<int>(table.integer("decimals", 0, {0, kMostDecimals}));
  tag.range = read_range(table);
  tag.values = table.texts("values");
  tag.where = table.where();
  return tag;
}

}  // namespace

std::vector<TagConfig> read_tags(const TomlTable& tags) {
  std::vector<TagConfig> read;
  for (const std::string& name : tags.keys()) {
    TagConfig tag = read_tag(tags.table(name), name);
    const bool known = std::ranges::any_of(
        read, [&](const TagConfig& other) { return naming::same_name(other.name, name); });
    if (name.empty()) {
      tags.report(name, "this tag has no name", "[tags.\"Main.level\"]", "0630");
    } else if (known) {
      tags.report(name, "the tag '" + name + "' stands here twice: upper and lower case are alike", {},
                  "0630");
    } else {
      read.push_back(std::move(tag));
    }
  }
  return read;
}

}  // namespace stepwright::config

#pragma once

// [tags] of a cell's configuration: what people want to know of a tag beside its value
// (hmi_web/doc/tags.md).
//
//   [tags."Main.level"]
//   unit = "l"
//   description = "level of the buffer"
//   group = "buffer"
//   decimals = 1               # shown behind the point, 0 to 9; default: by the type
//   range = [0, 200]           # what is normal: beyond it the page marks the value
//
//   [tags."Main.mode"]
//   values = ["off", "by hand", "automatic"]   # names of 0, 1, 2
//
// A tag is called as the program calls it, upper and lower case alike; "Main.levels" stands for all elements
// of an array. Diagnostics with their place: C0630 a name that is empty or there twice, C0631 a range with
// nothing in it.
//
// Plain data; read by load_cell_config.

#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

struct TagConfig {
  std::string name;
  std::string unit;
  std::string description;
  std::string group;
  std::optional<int> decimals;
  std::optional<settings::Range> range;
  std::vector<std::string> values;  // names of 0, 1, 2, ...
  result::Location where;
};

// Of the table [tags].
std::vector<TagConfig> read_tags(const settings::TomlTable& tags);

}  // namespace stepwright::config

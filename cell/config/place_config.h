#pragma once

// Places in the tables of a plant, and files that they name: what the tables of several plants have in
// common. Errors are reported to the document of the table. Not thread-safe, as the document.
//
//   for (const TomlTable& table : plant.tables("blockages")) blockages.push_back(read_blockage(table));

#include <filesystem>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/settings/toml_document.h"

namespace stepwright::config {

struct PlaceConfig {
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_deg = 0.0;
  result::Location where;
};

// A rectangle; its length is along the heading.
struct BlockageConfig {
  PlaceConfig place;
  double length_m = 1.0;
  double width_m = 1.0;
};

// x_m and y_m within 320 m, heading_deg or 0.
PlaceConfig read_place(const settings::TomlTable& table);
// A place with length_m and width_m.
BlockageConfig read_blockage(const settings::TomlTable& table);

// The file that `key` names, taken from `folder`; empty where the key is missing or there is no such file.
std::filesystem::path read_plant_file(const settings::TomlTable& table, const char* key,
                                      const std::filesystem::path& folder);

}  // namespace stepwright::config

#include "cell/config/place_config.h"

#include <string>
#include <system_error>

namespace stepwright::config {
namespace {

using settings::Range;
using settings::TomlTable;

constexpr Range kPlace{-320.0, 320.0};  // counts of centimetres in 16 bits
constexpr Range kAngle{-360.0, 360.0};
constexpr Range kLength{0.01, 640.0};

}  // namespace

PlaceConfig read_place(const TomlTable& table) {
  PlaceConfig place;
  place.x_m = table.required_number("x_m", kPlace);
  place.y_m = table.required_number("y_m", kPlace);
  place.heading_deg = table.number("heading_deg", 0.0, kAngle);
  place.where = table.where();
  return place;
}

BlockageConfig read_blockage(const TomlTable& table) {
  const PlaceConfig place = read_place(table);
  const double length_m = table.required_number("length_m", kLength);
  return {place, length_m, table.required_number("width_m", kLength)};
}

std::filesystem::path read_plant_file(const TomlTable& table, const char* key,
                                      const std::filesystem::path& folder) {
  const std::string text = table.text(key, "");
  if (text.empty()) return {};
  const std::filesystem::path file = folder / text;
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) return file;
  table.report(key, "there is no file " + file.string(), "paths are taken from the folder of this file");
  return {};
}

}  // namespace stepwright::config

#include "supervisor/map/map_file.h"

#include <fmt/format.h>

#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "supervisor/map/internal/gray_image.h"
#include "supervisor/map/internal/map_description.h"

namespace stepwright::fleet {

namespace {

using result::Result;

constexpr std::uintmax_t kLongestYaml = 64 * 1024;
constexpr std::uintmax_t kLongestImage = 256 * 1024 * 1024;
constexpr std::uint8_t kBlack = 0;
constexpr std::uint8_t kWhite = 254;  // what ROS writes for free cells

Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path, std::uintmax_t longest) {
  std::error_code error;
  const auto refuse = [&](std::string message) {
    return result::fail("F0101", {path.string(), 0, 0}, std::move(message));
  };
  if (!std::filesystem::is_regular_file(path, error)) return refuse("there is no such file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return refuse("cannot read the file: " + error.message());
  if (size > longest) return refuse(fmt::format("the file has {} bytes; {} are read at most", size, longest));
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) return refuse("cannot read the file");
  return bytes;
}

// As YAML writes it: only quotes mean something between single quotes.
std::string in_quotes(std::string_view text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

// Trinary, as ROS does it: occupied above one threshold, free below the other, unknown between.
OccupancyGrid to_grid(const internal::GrayImage& image, const internal::MapDescription& map) {
  OccupancyGrid grid({map.resolution_m, map.origin, image.columns, image.rows});
  std::size_t pixel = 0;
  for (std::int32_t row = image.rows - 1; row >= 0; --row) {
    for (std::int32_t column = 0; column < image.columns; ++column, ++pixel) {
      const double bright = image.brightness[pixel];
      const double occupied = map.negate ? bright : 1.0 - bright;
      if (bright < 0.0 || occupied >= map.free_thresh) grid.set({column, row}, true);
    }
  }
  return grid;
}

}  // namespace

Result<OccupancyGrid> read_map(const std::filesystem::path& yaml) {
  auto text = read_file(yaml, kLongestYaml);
  if (!text) return forward(text);
  auto map =
      internal::read_description({reinterpret_cast<const char*>(text->data()), text->size()}, yaml.string());
  if (!map) return forward(map);
  const std::filesystem::path path = yaml.parent_path() / map->image;
  auto bytes = read_file(path, kLongestImage);
  if (!bytes) return forward(bytes);
  auto image = internal::is_png(*bytes) ? internal::read_png(*bytes, path.string())
                                        : internal::read_pgm(*bytes, path.string());
  if (!image) return forward(image);
  return to_grid(*image, *map);
}

Result<void> write_map(const OccupancyGrid& grid, const std::filesystem::path& yaml) {
  const GridFrame& frame = grid.frame();
  const std::filesystem::path image = std::filesystem::path(yaml).replace_extension(".pgm");
  std::ofstream picture(image, std::ios::binary);
  picture << fmt::format("P5\n{} {}\n255\n", frame.columns, frame.rows);
  for (std::int32_t row = frame.rows - 1; row >= 0; --row) {
    for (std::int32_t column = 0; column < frame.columns; ++column) {
      picture.put(static_cast<char>(grid.blocked({column, row}) ? kBlack : kWhite));
    }
  }
  picture.close();
  if (!picture) return result::fail("F0105", {image.string(), 0, 0}, "cannot write the file");
  std::ofstream text(yaml);
  text << fmt::format(
      "image: {}\nresolution: {}\norigin: [{}, {}, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: "
      "0.196\n",
      in_quotes(image.filename().string()), frame.resolution_m, frame.origin.x_m, frame.origin.y_m);
  text.close();
  if (!text) return result::fail("F0105", {yaml.string(), 0, 0}, "cannot write the file");
  return {};
}

}  // namespace stepwright::fleet

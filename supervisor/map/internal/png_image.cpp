#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>

#include "supervisor/map/internal/gray_image.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet::internal {

namespace {

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::uint64_t kLongestSide = 32768;

// libpng's control structure; freed however reading ends.
class PngImage {
 public:
  PngImage() { image_.version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(&image_); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;

  png_image* operator->() { return &image_; }
  png_image* get() { return &image_; }

 private:
  png_image image_{};
};

// ROS takes the mean of the colours.
float brightness_of(const std::uint8_t* rgba) {
  constexpr std::uint8_t kOpaque = 255;
  return rgba[3] != kOpaque ? -1.0f : static_cast<float>(rgba[0] + rgba[1] + rgba[2]) / (3.0f * 255.0f);
}

}  // namespace

std::optional<std::string> wrong_size(std::uint64_t columns, std::uint64_t rows) {
  if (columns == 0 || rows == 0) return "the image is empty";
  if (columns > kLongestSide || rows > kLongestSide || columns * rows > kMostCells) {
    return fmt::format("the image has {} x {} pixels; a side may have {}, all together {}", columns, rows,
                       kLongestSide, kMostCells);
  }
  return std::nullopt;
}

bool is_png(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= kSignature.size() && std::ranges::equal(bytes.first(kSignature.size()), kSignature);
}

result::Result<GrayImage> read_png(std::span<const std::uint8_t> bytes, const std::string& file) {
  PngImage png;
  if (png_image_begin_read_from_memory(png.get(), bytes.data(), bytes.size()) == 0) {
    return result::fail("F0104", {file, 0, 0}, fmt::format("libpng: {}", png->message));
  }
  if (auto wrong = wrong_size(png->width, png->height)) {
    return result::fail("F0104", {file, 0, 0}, *std::move(wrong));
  }
  png->format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(*png.get()));
  GrayImage image{static_cast<std::int32_t>(png->width), static_cast<std::int32_t>(png->height), {}};
  if (png_image_finish_read(png.get(), nullptr, pixels.data(), 0, nullptr) == 0) {
    return result::fail("F0104", {file, 0, 0}, fmt::format("libpng: {}", png->message),
                        "the file may be cut off");
  }
  image.brightness.reserve(pixels.size() / 4);
  for (std::size_t k = 0; k < pixels.size(); k += 4) image.brightness.push_back(brightness_of(&pixels[k]));
  return image;
}

}  // namespace stepwright::fleet::internal

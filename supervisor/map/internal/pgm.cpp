#include <fmt/format.h>

#include <utility>

#include "supervisor/map/internal/gray_image.h"

namespace stepwright::fleet::internal {

namespace {

constexpr std::uint32_t kLargestNumber = 1'000'000;  // more digits are no number of a map
constexpr std::uint32_t kLargestMaximum = 65535;

bool is_space(std::uint8_t c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

// Portable gray map as netpbm defines it (pgm(5)): a header of numbers with comments, then samples.
class PgmReader {
 public:
  PgmReader(std::span<const std::uint8_t> bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  result::Result<GrayImage> read() {
    if (bytes_.size() < 2 || bytes_[0] != 'P' || (bytes_[1] != '2' && bytes_[1] != '5')) {
      return refuse("this is neither a PGM (P2, P5) nor a PNG file", "convert the image to one of them");
    }
    const bool plain = bytes_[1] == '2';
    at_ = 2;
    const auto columns = number("the width");
    if (!columns) return tl::unexpected(columns.error());
    const auto rows = number("the height");
    if (!rows) return tl::unexpected(rows.error());
    if (auto wrong = wrong_size(*columns, *rows)) return refuse(*std::move(wrong));
    const auto maximum = number("the maximum value");
    if (!maximum) return tl::unexpected(maximum.error());
    if (*maximum == 0 || *maximum > kLargestMaximum) {
      return refuse(fmt::format("the maximum value is {}, outside 1 to {}", *maximum, kLargestMaximum));
    }
    GrayImage image{static_cast<std::int32_t>(*columns), static_cast<std::int32_t>(*rows), {}};
    const std::size_t pixels = static_cast<std::size_t>(*columns) * *rows;
    return plain ? plain_samples(std::move(image), pixels, *maximum)
                 : raw_samples(std::move(image), pixels, *maximum);
  }

 private:
  tl::unexpected<result::Diagnostics> refuse(std::string message, std::string hint = {}) const {
    return result::fail("F0104", {file_, line_, static_cast<std::uint32_t>(at_ - line_start_ + 1)},
                        std::move(message), std::move(hint));
  }

  void step() {
    if (bytes_[at_++] == '\n') {
      ++line_;
      line_start_ = at_;
    }
  }

  void skip_space_and_comments() {
    while (at_ < bytes_.size() && (is_space(bytes_[at_]) || bytes_[at_] == '#')) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else {
        step();
      }
    }
  }

  result::Result<std::uint32_t> number(std::string_view what) {
    skip_space_and_comments();
    if (at_ >= bytes_.size()) return refuse(fmt::format("the file ends where {} is due", what));
    std::uint32_t value = 0;
    const std::size_t first = at_;
    while (at_ < bytes_.size() && bytes_[at_] >= '0' && bytes_[at_] <= '9' && value <= kLargestNumber) {
      value = value * 10 + (bytes_[at_] - std::uint32_t{'0'});
      ++at_;
    }
    if (at_ == first || value > kLargestNumber) return refuse(fmt::format("{} is no number of a map", what));
    return value;
  }

  result::Result<GrayImage> plain_samples(GrayImage image, std::size_t pixels, std::uint32_t maximum) {
    // Each sample takes two bytes at least, but the last.
    if (bytes_.size() - at_ < 2 * pixels - 1) return too_short(pixels, 2 * pixels - 1);
    image.brightness.reserve(pixels);
    for (std::size_t k = 0; k < pixels; ++k) {
      const auto value = number("a sample");
      if (!value) return tl::unexpected(value.error());
      if (*value > maximum) return refuse(fmt::format("the sample {} is above {}", *value, maximum));
      image.brightness.push_back(static_cast<float>(*value) / static_cast<float>(maximum));
    }
    return image;
  }

  result::Result<GrayImage> raw_samples(GrayImage image, std::size_t pixels, std::uint32_t maximum) {
    if (at_ >= bytes_.size() || !is_space(bytes_[at_])) return refuse("white space is due after the maximum");
    step();
    const std::size_t width = maximum > 255 ? 2 : 1;
    if (bytes_.size() - at_ < width * pixels) return too_short(pixels, width * pixels);
    image.brightness.reserve(pixels);
    for (std::size_t k = 0; k < pixels; ++k) {
      const std::uint8_t* sample = &bytes_[at_ + width * k];
      const std::uint32_t value = width == 1 ? sample[0] : sample[0] * 256u + sample[1];
      if (value > maximum) return refuse(fmt::format("the sample {} is above {}", value, maximum));
      image.brightness.push_back(static_cast<float>(value) / static_cast<float>(maximum));
    }
    return image;
  }

  tl::unexpected<result::Diagnostics> too_short(std::size_t pixels, std::size_t due) const {
    return refuse(
        fmt::format("{} bytes follow the header; {} pixels need {}", bytes_.size() - at_, pixels, due),
        "the file is cut off");
  }

  std::span<const std::uint8_t> bytes_;
  const std::string& file_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1;
  std::size_t line_start_ = 0;
};

}  // namespace

result::Result<GrayImage> read_pgm(std::span<const std::uint8_t> bytes, const std::string& file) {
  return PgmReader(bytes, file).read();
}

}  // namespace stepwright::fleet::internal

#include "tests/bench/fleet/figure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace stepwright::bench::fleet {

namespace {

constexpr double kWidth = 640.0, kHeight = 400.0, kLeft = 90.0, kTop = 20.0, kRight = 150.0, kBottom = 50.0;

std::string text(const char* format, auto... values) {
  char buffer[400];
  std::snprintf(buffer, sizeof(buffer), format, values...);
  return buffer;
}

class Plot {
 public:
  explicit Plot(std::span<const CircleRow> rows) : rows_(rows) {
    for (const CircleRow& row : rows) {
      for (const Times* times : {&row.ours, &row.fair, &row.literal}) {
        if (times->ms.empty()) continue;
        low_ = std::min(low_, std::floor(std::log10(std::max(1e-4, times->mean()))));
        high_ = std::max(high_, std::ceil(std::log10(std::max(1e-4, times->mean()))));
      }
    }
  }

  std::string svg() const {
    std::string out = text(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
        "font-size=\"12\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
        kWidth, kHeight);
    for (double power = low_; power <= high_; ++power) {
      out += text(
          "<path d=\"M%g %gH%g\" stroke=\"#ddd\"/><text x=\"%g\" y=\"%g\" text-anchor=\"end\">%g ms</text>\n",
          kLeft, y(power), kWidth - kRight, kLeft - 6, y(power) + 4, std::pow(10.0, power));
    }
    for (const CircleRow& row : rows_) {
      out += text("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">%u</text>\n", x(row.vehicles), kHeight - 32,
                  row.vehicles);
    }
    out += text("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">vehicles</text>\n",
                (kLeft + kWidth - kRight) / 2, kHeight - 12);
    out += curve(&CircleRow::literal, "paper-literal", "#c33");
    out += curve(&CircleRow::fair, "paper-fair", "#e90");
    out += curve(&CircleRow::ours, "Stepwright", "#06c");
    return out + "</svg>\n";
  }

 private:
  double x(std::uint32_t vehicles) const {
    const double first = rows_.front().vehicles, last = rows_.back().vehicles;
    return kLeft + 20 +
           (kWidth - kLeft - kRight - 40) * (last > first ? (vehicles - first) / (last - first) : 0.5);
  }
  double y(double power) const {
    return kTop + (kHeight - kTop - kBottom) * (high_ - power) / std::max(1.0, high_ - low_);
  }

  std::string curve(Times CircleRow::*solver, const char* name, const char* colour) const {
    std::string points, dots;
    double end = 0.0;
    for (const CircleRow& row : rows_) {
      if ((row.*solver).ms.empty()) continue;
      end = y(std::log10(std::max(1e-4, (row.*solver).mean())));
      points += text("%s%.1f %.1f", points.empty() ? "M" : "L", x(row.vehicles), end);
      dots += text("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\"/>", x(row.vehicles), end, colour);
    }
    if (points.empty()) return {};
    return "<path d=\"" + points + text("\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\"/>", colour) +
           dots +
           text("<text x=\"%g\" y=\"%.1f\" fill=\"%s\">%s</text>\n", kWidth - kRight + 8, end + 4, colour,
                name);
  }

  std::span<const CircleRow> rows_;
  double low_ = 0.0, high_ = 1.0;
};

}  // namespace

std::string figure_4(std::span<const CircleRow> rows) {
  return Plot(rows).svg();
}

}  // namespace stepwright::bench::fleet

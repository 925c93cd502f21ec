#include "runtime/scan_test/scan_test_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

namespace stepwright::scan_test {
namespace {

constexpr double kWidth = 860, kHeight = 420, kLeft = 76, kRight = 150, kTop = 56, kBottom = 52;
constexpr const char* kStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#222}.t{font-weight:600;font-size:14px}"
    ".g{stroke:#ddd}.scan{fill:none;stroke:#2f6f9f;stroke-width:2}"
    ".bare{fill:none;stroke:#8a9099;stroke-width:2;stroke-dasharray:6 3}.m{text-anchor:middle}"
    ".e{text-anchor:end}</style>\n";

struct Point {
  double later = 1.0;  // share of the wake-ups that were later
  double us = 0.0;
};

std::vector<Point> curve(const scan::Histogram& histogram) {
  std::vector<Point> points;
  std::uint64_t seen = 0;
  const auto total = static_cast<double>(histogram.count());
  for (std::uint32_t i = 0; i < scan::Histogram::bucket_count(); ++i) {
    if (histogram.bucket(i) == 0) continue;
    seen += histogram.bucket(i);
    const std::int64_t edge_ns = std::min(scan::Histogram::bucket_edge_ns(i), histogram.max_ns());
    points.push_back({1.0 - static_cast<double>(seen) / total, static_cast<double>(edge_ns) / 1'000.0});
  }
  return points;
}

// Both axes are logarithmic: the rare and the late are what matters.
class Plot {
 public:
  Plot(double smallest_share, double low_us, double high_us)
      : decades_(std::max(1.0, std::ceil(-std::log10(smallest_share)))),
        low_(std::floor(std::log10(low_us))),
        high_(std::max(std::ceil(std::log10(high_us)), low_ + 1.0)) {}

  double x(double later) const {
    const double decade = std::min(decades_, -std::log10(std::max(later, 1e-12)));
    return kLeft + decade / decades_ * (kWidth - kLeft - kRight);
  }
  double y(double us) const {
    const double part = (std::log10(std::max(us, 1e-3)) - low_) / (high_ - low_);
    return kHeight - kBottom - std::clamp(part, 0.0, 1.0) * (kHeight - kTop - kBottom);
  }

  void add_axes(std::string& svg) const {
    const auto out = std::back_inserter(svg);
    for (double decade = 0; decade <= decades_; ++decade) {
      const double at = x(std::pow(10.0, -decade));
      const std::string label = decade == 0 ? "0 %"
                                            : fmt::format("{:.{}f} %", 100.0 - std::pow(10.0, 2.0 - decade),
                                                          std::max(0, static_cast<int>(decade) - 2));
      fmt::format_to(out,
                     "<line class=\"g\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
                     "<text class=\"m\" x=\"{0:.1f}\" y=\"{3}\">{4}</text>\n",
                     at, kTop, kHeight - kBottom, kHeight - kBottom + 18, label);
    }
    for (double power = low_; power <= high_; ++power) {
      const double us = std::pow(10.0, power);
      fmt::format_to(out,
                     "<line class=\"g\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>"
                     "<text class=\"e\" x=\"{3}\" y=\"{4:.1f}\">{5:g} us</text>\n",
                     kLeft, kWidth - kRight, y(us), kLeft - 8, y(us) + 4, us);
    }
    fmt::format_to(out, "<text class=\"m\" x=\"{:.1f}\" y=\"{}\">wake-ups that were not later</text>\n",
                   (kLeft + kWidth - kRight) / 2, kHeight - 12);
  }

  // A staircase: every share up to the next point has this latency at most.
  void add_curve(std::string& svg, const std::vector<Point>& points, const char* style) const {
    const auto out = std::back_inserter(svg);
    fmt::format_to(out, "<polyline class=\"{}\" points=\"", style);
    double from = x(1.0);
    for (const Point& point : points) {
      const double to = x(point.later);
      fmt::format_to(out, "{:.1f},{:.1f} {:.1f},{:.1f} ", from, y(point.us), to, y(point.us));
      from = to;
    }
    svg += "\"/>\n";
  }

 private:
  double decades_;
  double low_;
  double high_;
};

void add_legend(std::string& svg, const char* style, const char* name, const scan::Histogram& histogram,
                double y) {
  fmt::format_to(std::back_inserter(svg),
                 "<line class=\"{0}\" x1=\"{1}\" x2=\"{2}\" y1=\"{3}\" y2=\"{3}\"/>"
                 "<text x=\"{4}\" y=\"{5}\">{6}</text><text x=\"{4}\" y=\"{7}\">p99.9 {8:.1f} us</text>"
                 "<text x=\"{4}\" y=\"{9}\">max {10:.1f} us</text>\n",
                 style, kWidth - kRight + 12, kWidth - kRight + 40, y, kWidth - kRight + 46, y + 4, name,
                 y + 20, static_cast<double>(histogram.percentile_ns(99'900)) / 1e3, y + 36,
                 static_cast<double>(histogram.max_ns()) / 1e3);
}

}  // namespace

std::string to_svg(const Measurement& measured) {
  const std::vector<Point> scan = curve(measured.scan.latency), bare = curve(measured.bare.latency);
  const auto count = static_cast<double>(std::max<std::uint64_t>(measured.scan.latency.count(), 10));
  double low = 1e9, high = 1.0;
  for (const auto* points : {&scan, &bare}) {
    for (const Point& point : *points) {
      low = std::min(low, std::max(point.us, 0.1));
      high = std::max(high, point.us);
    }
  }
  const Plot plot(1.0 / count, std::min(low, high), high);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\">\n{}"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text class=\"t\" x=\"16\" y=\"24\">Wake-up latency of a scan every {} us beside a bare loop</text>\n"
      "<text x=\"16\" y=\"42\">{} scans, {} overruns</text>\n",
      kWidth, kHeight, kStyle, measured.interval_us, measured.scan.cycles, measured.overruns);
  plot.add_axes(svg);
  plot.add_curve(svg, bare, "bare");
  plot.add_curve(svg, scan, "scan");
  add_legend(svg, "scan", "scan", measured.scan.latency, kTop + 10);
  add_legend(svg, "bare", "bare loop", measured.bare.latency, kTop + 74);
  return svg + "</svg>\n";
}

}  // namespace stepwright::scan_test

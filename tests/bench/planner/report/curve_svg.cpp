#include "tests/bench/planner/report/curve_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace stepwright::bench {
namespace {

constexpr double kWidth = 860, kPanel = 300, kLeft = 84, kRight = 150, kTop = 56, kBottom = 52;
constexpr double kHeight = 2 * kPanel + kTop + kBottom;
constexpr const char* kStyle =
    "<style>text{font:12px system-ui,sans-serif;fill:#222}.t{font-weight:600;font-size:14px}"
    ".g{stroke:#ddd}.ours{fill:none;stroke:#2f6f9f;stroke-width:2}"
    ".ground{fill:none;stroke:#2f6f9f;stroke-width:1.5;stroke-dasharray:2 3}"
    ".base{fill:none;stroke:#8a9099;stroke-width:2;stroke-dasharray:6 3}.m{text-anchor:middle}"
    ".od,.gd{fill:#2f6f9f}.bd{fill:#8a9099}.e{text-anchor:end}</style>\n";

struct Point {
  double size = 0.0, value = 0.0;
};

// The value of one line at one point; below zero where it has none.
using Value = std::function<double(const ScalePoint&)>;

struct Line {
  const char* style;
  const char* name;
  std::vector<Point> points;
};

Line line(const char* style, const char* name, const Curve& curve, const Value& value) {
  Line line{style, name, {}};
  for (const ScalePoint& point : curve.points) {
    const double v = value(point);
    if (v > 0.0) line.points.push_back({static_cast<double>(point.size), v});
  }
  return line;
}

// One panel: its scales and where it stands.
class Panel {
 public:
  Panel(double top, const char* unit, const Curve& curve, std::vector<Line> lines)
      : top_(top), unit_(unit), lines_(std::move(lines)) {
    for (const ScalePoint& point : curve.points) sizes_.push_back(point.size);
    double low = 1e300, high = 0.0;
    for (const Line& line : lines_) {
      for (const Point& point : line.points) {
        low = std::min(low, point.value);
        high = std::max(high, point.value);
      }
    }
    low_ = std::floor(std::log10(std::min(low, 1e9)));
    high_ = std::max(std::ceil(std::log10(std::max(high, 1e-9))), low_ + 1.0);
  }

  void add(std::string& svg) const {
    const auto out = std::back_inserter(svg);
    for (double power = low_; power <= high_; ++power) {
      const double at = y(std::pow(10.0, power));
      fmt::format_to(out,
                     "<line class=\"g\" x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>"
                     "<text class=\"e\" x=\"{3}\" y=\"{4:.1f}\">{5:g} {6}</text>\n",
                     kLeft, kWidth - kRight, at, kLeft - 8, at + 4, std::pow(10.0, power), unit_);
    }
    double last = -100.0;
    for (const int size : sizes_) {
      if (x(size) - last < 24.0) continue;  // labels must not touch
      last = x(size);
      fmt::format_to(out,
                     "<line class=\"g\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>"
                     "<text class=\"m\" x=\"{0:.1f}\" y=\"{3}\">{4}</text>\n",
                     last, top_, bottom(), bottom() + 16, size);
    }
    fmt::format_to(out, "<text class=\"m\" x=\"{:.1f}\" y=\"{}\">size</text>\n",
                   (kLeft + kWidth - kRight) / 2, bottom() + 32);
    double legend = top_ + 10;
    for (const Line& line : lines_) {
      add_line(svg, line);
      fmt::format_to(out,
                     "<line class=\"{0}\" x1=\"{1}\" x2=\"{2}\" y1=\"{3}\" y2=\"{3}\"/>"
                     "<text x=\"{4}\" y=\"{5}\">{6}</text>\n",
                     line.style, kWidth - kRight + 12, kWidth - kRight + 40, legend, kWidth - kRight + 46,
                     legend + 4, line.name);
      legend += 20;
    }
  }

 private:
  double bottom() const { return top_ + kPanel - 48; }
  double x(double size) const {
    const double first = std::log(sizes_.front()), last = std::log(sizes_.back());
    const double part = last > first ? (std::log(size) - first) / (last - first) : 0.5;
    return kLeft + 10 + part * (kWidth - kLeft - kRight - 20);
  }
  double y(double value) const {
    const double part = (std::log10(value) - low_) / (high_ - low_);
    return bottom() - std::clamp(part, 0.0, 1.0) * (bottom() - top_);
  }
  void add_line(std::string& svg, const Line& line) const {
    const auto out = std::back_inserter(svg);
    fmt::format_to(out, "<polyline class=\"{}\" points=\"", line.style);
    for (const Point& point : line.points)
      fmt::format_to(out, "{:.1f},{:.1f} ", x(point.size), y(point.value));
    svg += "\"/>\n";
    for (const Point& point : line.points) {
      fmt::format_to(
          out,
          "<circle class=\"{}d\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"><title>{:g} {}</title></circle>\n",
          line.style[0], x(point.size), y(point.value), point.value, unit_);
    }
  }

  double top_;
  const char* unit_;
  std::vector<Line> lines_;
  std::vector<int> sizes_;
  double low_ = 0.0, high_ = 1.0;
};

double first_plan_ms(const Measurement& measured) {
  return measured.solved() ? measured.first().wall_ms : -1.0;
}

double peak_mb(const Measurement& measured) {
  return measured.solved() ? measured.peak_mb : -1.0;
}

}  // namespace

std::string to_svg(const Curve& curve) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\">\n{}"
      "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
      "<text class=\"t\" x=\"16\" y=\"24\">{}: time to the first plan and memory over the size</text>\n"
      "<text x=\"16\" y=\"42\">end of the planner: {}; of the baseline: {}</text>\n",
      kWidth, kHeight, kStyle, curve.domain, curve.ours_ended, curve.baseline_ended);
  if (curve.points.empty()) return svg + "</svg>\n";
  Panel(kTop + 10, "ms", curve,
        {line("ours", "planner", curve, [](const ScalePoint& p) { return first_plan_ms(p.ours); }),
         line("ground", "its grounding", curve,
              [](const ScalePoint& p) { return p.ground.operators > 0 ? p.ground.grounding_ms : -1.0; }),
         line("base", "baseline", curve, [](const ScalePoint& p) { return first_plan_ms(p.baseline); })})
      .add(svg);
  Panel(kTop + 10 + kPanel, "MB", curve,
        {line("ours", "planner", curve, [](const ScalePoint& p) { return peak_mb(p.ours); }),
         line("base", "baseline", curve, [](const ScalePoint& p) { return peak_mb(p.baseline); })})
      .add(svg);
  return svg + "</svg>\n";
}

}  // namespace stepwright::bench

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "tests/bench/shift/report.h"

namespace stepwright::bench::shift {

namespace {

constexpr double kScale = 10.0;  // pixels in a metre

constexpr std::array<const char*, 6> kColours = {"#06c", "#c33", "#e90", "#383", "#939", "#555"};

void draw_floor(const Scenario& scenario, std::string& svg) {
  const fleet::OccupancyGrid& grid = scenario.hall.grid;
  const fleet::GridFrame& frame = grid.frame();
  const double height_m = frame.rows * frame.resolution_m;
  for (int row = 0; row < frame.rows; ++row) {
    for (int first = 0; first < frame.columns; ++first) {
      if (!grid.blocked({first, row})) continue;
      int last = first;
      while (last + 1 < frame.columns && grid.blocked({last + 1, row})) ++last;
      svg += fmt::format("<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\"/>",
                         kScale * frame.resolution_m * first,
                         kScale * (height_m - frame.resolution_m * (row + 1)),
                         kScale * frame.resolution_m * (last - first + 1), kScale * frame.resolution_m);
      first = last;
    }
  }
}

struct Curve {
  const char* name;
  const char* colour;
  std::function<double(const SweepRow&)> value;  // 0 to 1 is bottom to top
};

}  // namespace

std::string picture_of(const Scenario& scenario, const PlantRun& run) {
  const fleet::GridFrame& frame = scenario.hall.grid.frame();
  const double width_m = frame.columns * frame.resolution_m, height_m = frame.rows * frame.resolution_m;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/><g fill=\"#999\">",
      kScale * width_m, kScale * height_m);
  draw_floor(scenario, svg);
  svg += "</g>\n<g fill=\"#c33\" fill-opacity=\"0.3\">";
  for (const Closing& closing : scenario.closings) {
    const Rectangle& place = scenario.places[closing.place];
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>",
                       kScale * place.low.x_m, kScale * (height_m - place.high.y_m),
                       kScale * (place.high.x_m - place.low.x_m), kScale * (place.high.y_m - place.low.y_m));
  }
  svg += "</g>\n<g fill=\"none\" stroke-width=\"1\" stroke-opacity=\"0.25\">";
  for (std::size_t v = 0; v < run.tracks.size(); ++v) {
    svg += fmt::format("<path stroke=\"{}\" d=\"", kColours[v % kColours.size()]);
    geometry::Pose last{-1e9, 0.0, 0.0};
    bool first = true;
    for (const geometry::Pose& pose : run.tracks[v]) {
      if (!first && geometry::distance(pose.position(), last.position()) < 0.5) continue;
      svg += fmt::format("{}{:.0f} {:.0f}", first ? "M" : "L", kScale * pose.x_m,
                         kScale * (height_m - pose.y_m));
      last = pose;
      first = false;
    }
    svg += "\"/>\n";
  }
  return svg + "</g></svg>\n";
}

std::uint32_t enough_vehicles(std::span<const SweepRow> rows) {
  std::size_t fewest = rows.front().summary.late;
  for (const SweepRow& row : rows) fewest = std::min(fewest, row.summary.late);
  const std::size_t bound = std::max(fewest, rows.front().summary.released / 200);
  for (const SweepRow& row : rows)
    if (row.summary.late <= bound) return row.vehicles;
  return rows.back().vehicles;
}

std::string plot_of(std::span<const SweepRow> rows, double hours) {
  constexpr double kWidth = 700.0, kHeight = 360.0, kLeft = 50.0, kRight = 250.0, kTop = 20.0, kBottom = 45.0;
  double most = 1.0, most_tardiness_s = 1.0;
  for (const SweepRow& row : rows) {
    most = std::max(most, static_cast<double>(row.vehicles));
    most_tardiness_s = std::max(most_tardiness_s, row.summary.mean_tardiness_s);
  }
  const auto x = [&](double vehicles) { return kLeft + (kWidth - kLeft - kRight) * vehicles / most; };
  const auto y = [&](double part) { return kTop + (kHeight - kTop - kBottom) * (1.0 - part); };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      kWidth, kHeight);
  for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    svg += fmt::format(
        "<path d=\"M{} {}H{}\" stroke=\"#ddd\"/><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.0f} "
        "%</text>\n",
        kLeft, y(part), kWidth - kRight, kLeft - 6, y(part) + 4, 100.0 * part);
  }
  for (double n = 0.0; n <= most; n += 10.0)
    svg +=
        fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{:.0f}</text>\n", x(n), kHeight - 28, n);
  svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">vehicles</text>\n",
                     0.5 * (kLeft + kWidth - kRight), kHeight - 10);
  const std::uint32_t enough = enough_vehicles(rows);
  svg += fmt::format(
      "<path d=\"M{0} {1}V{2}\" stroke=\"#000\" stroke-dasharray=\"4 3\"/><text x=\"{3}\" y=\"{4}\">{5} "
      "suffice</text>\n",
      x(enough), y(0.0), kTop, x(enough) + 5, y(0.5), enough);
  const std::string delivered = fmt::format("delivered (100 % = {:.0f} an hour)",
                                            static_cast<double>(rows.front().summary.released) / hours);
  const std::string tardiness = fmt::format("tardiness (100 % = {:.0f} s)", most_tardiness_s);
  const std::array<Curve, 4> curves = {
      Curve{delivered.c_str(), "#06c",
            [](const SweepRow& r) {
              return static_cast<double>(r.summary.delivered) / static_cast<double>(r.summary.released);
            }},
      Curve{"late", "#c33",
            [](const SweepRow& r) {
              return static_cast<double>(r.summary.late) / static_cast<double>(r.summary.released);
            }},
      Curve{tardiness.c_str(), "#e90",
            [&](const SweepRow& r) { return r.summary.mean_tardiness_s / most_tardiness_s; }},
      Curve{"vehicles with a job", "#383", [](const SweepRow& r) { return r.summary.utilisation; }}};
  double label = kTop + 10.0;
  for (const Curve& curve : curves) {
    std::string points;
    for (const SweepRow& row : rows)
      points +=
          fmt::format("{}{:.1f} {:.1f}", points.empty() ? "M" : "L", x(row.vehicles), y(curve.value(row)));
    svg += fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/><text x=\"{}\" y=\"{}\" "
        "fill=\"{}\">{}</text>\n",
        points, curve.colour, kWidth - kRight + 10, label, curve.colour, curve.name);
    label += 18.0;
  }
  return svg + "</svg>\n";
}

}  // namespace stepwright::bench::shift

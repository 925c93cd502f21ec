#include "supervisor/tamp/intervals/drawing/cell_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "runtime/ground/markup/xml_text.h"

namespace stepwright::tamp {
namespace {

constexpr double kPixelsPerMetre = 400.0;
constexpr double kMargin_m = 0.1;
constexpr std::array kColours{"#2f6fb3", "#b3622f", "#3c8f4e", "#7b4fa0"};
constexpr std::int64_t kMostRows = 400;  // of cells that are drawn along an axis

struct Frame {
  double left_m = 0.0, right_m = 0.0, low_m = 0.0, high_m = 0.0;

  void hold(double x_m, double y_m) {
    left_m = std::min(left_m, x_m);
    right_m = std::max(right_m, x_m);
    low_m = std::min(low_m, y_m);
    high_m = std::max(high_m, y_m);
  }
  // x to the right, y upwards.
  double x(double x_m) const { return kPixelsPerMetre * (x_m - left_m + kMargin_m); }
  double y(double y_m) const { return kPixelsPerMetre * (high_m - y_m + kMargin_m); }
};

Frame frame_of(const Network& network) {
  Frame frame;
  for (const Region& region : network.cell().regions) {
    const double half = 0.5 * std::hypot(region.size_x_m, region.size_y_m);
    frame.hold(region.x_m - half, region.y_m - half);
    frame.hold(region.x_m + half, region.y_m + half);
  }
  for (const Object& object : network.cell().objects) frame.hold(object.start.x_m, object.start.y_m);
  for (const Network::Visit& visit : network.visits()) {
    const ReachGrid& grid = visit.reach->grid();
    frame.hold(std::max(-3.0, metres_of(grid.extent(0).low_nm)),
               std::max(-3.0, metres_of(grid.extent(1).low_nm)));
    frame.hold(std::min(3.0, metres_of(grid.extent(0).high_nm)),
               std::min(3.0, metres_of(grid.extent(1).high_nm)));
  }
  return frame;
}

std::string reach_of(const Frame& frame, const ReachBounds& reach, std::int64_t tool_nm, const char* colour) {
  const ReachGrid& grid = reach.grid();
  const std::int64_t z = grid.row(2, tool_nm);
  if (!grid.has(2, z) || grid.cells[0] > kMostRows || grid.cells[1] > kMostRows) return {};
  std::string text = fmt::format("<g class=\"reach\" fill=\"{}\">\n", colour);
  for (std::int64_t y = 0; y < grid.cells[1]; ++y) {
    for (std::int64_t x = 0; x < grid.cells[0]; ++x) {
      double turn = 0.0;
      for (const Arc arc : reach.arcs(grid.index(x, y, z)))
        turn += static_cast<double>(arc.width) / 4294967296.0;
      if (turn <= 0.0) continue;
      const Span across = grid.span(0, x), along = grid.span(1, y);
      text += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill-opacity=\"{:.2f}\"/>\n",
          frame.x(metres_of(across.low_nm)), frame.y(metres_of(along.high_nm)),
          kPixelsPerMetre * metres_of(across.width_nm()), kPixelsPerMetre * metres_of(along.width_nm()),
          0.05 + 0.4 * turn);
    }
  }
  return text + "</g>\n";
}

std::string label(const Frame& frame, double x_m, double y_m, const std::string& text) {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"13\" font-family=\"sans-serif\">{}</text>\n",
      frame.x(x_m) + 4.0, frame.y(y_m) - 4.0, markup::xml_escaped(text));
}

std::string region_of(const Frame& frame, const Region& region) {
  return fmt::format(
             "<rect class=\"region\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
             "transform=\"rotate({:.2f} {:.1f} {:.1f})\" fill=\"none\" stroke=\"#333\"/>\n",
             frame.x(region.x_m - 0.5 * region.size_x_m), frame.y(region.y_m + 0.5 * region.size_y_m),
             kPixelsPerMetre * region.size_x_m, kPixelsPerMetre * region.size_y_m,
             -region.heading_rad * 180.0 / std::numbers::pi, frame.x(region.x_m), frame.y(region.y_m)) +
         label(frame, region.x_m - 0.5 * region.size_x_m, region.y_m + 0.5 * region.size_y_m,
               fmt::format("{} ({:.2f} m)", region.name, region.z_m));
}

// What is left of a place that is no point.
std::string place_of(const Frame& frame, const Network& network, const Network::Place& place) {
  const Box box = network.box(place.spot);
  if (box[0].empty() || box[1].empty() || (box[0].width_nm() == 0 && box[1].width_nm() == 0)) return {};
  return fmt::format(
      "<rect class=\"left\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#e0b000\" "
      "fill-opacity=\"0.3\" stroke=\"#a07000\" stroke-dasharray=\"4 3\"/>\n",
      frame.x(metres_of(box[0].low_nm)), frame.y(metres_of(box[1].high_nm)),
      kPixelsPerMetre * metres_of(box[0].width_nm()), kPixelsPerMetre * metres_of(box[1].width_nm()));
}

}  // namespace

std::string cell_svg(const Network& network) {
  const Frame frame = frame_of(network);
  const WorkCell& cell = network.cell();
  const double width = frame.x(frame.right_m + kMargin_m), height = frame.y(frame.low_m - kMargin_m);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n"
      "<title>Reach from above</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
      width, height);
  std::vector<const ReachBounds*> drawn;
  for (const Network::Visit& visit : network.visits()) {
    if (std::ranges::find(drawn, visit.reach) != drawn.end()) continue;
    const Span height_nm = network.box(network.places()[visit.place].spot)[2];
    if (height_nm.empty()) continue;
    svg += reach_of(frame, *visit.reach, height_nm.low_nm + visit.rise_nm,
                    kColours[drawn.size() % kColours.size()]);
    drawn.push_back(visit.reach);
  }
  for (const Region& region : cell.regions) svg += region_of(frame, region);
  for (const Network::Place& place : network.places()) svg += place_of(frame, network, place);
  for (const Object& object : cell.objects) {
    svg += fmt::format("<circle class=\"object\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" fill=\"#333\"/>\n",
                       frame.x(object.start.x_m), frame.y(object.start.y_m));
    svg += label(frame, object.start.x_m, object.start.y_m, object.name);
  }
  return svg + "</svg>\n";
}

}  // namespace stepwright::tamp

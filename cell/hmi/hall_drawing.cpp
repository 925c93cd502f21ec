#include "cell/hmi/hall_drawing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "cell/hmi/drawing_units.h"
#include "runtime/ground/markup/xml_text.h"

namespace stepwright::hmi {
namespace {

using core::RegionDescription;
using core::RegionKind;
using server::PointSourceKind;

constexpr double kWidth = 1000.0;  // of the drawing, in its units
constexpr double kMargin = 10.0;
constexpr double kHallCentimetre_m = 0.01;
constexpr double kHallCentidegree_rad = std::numbers::pi / 18'000.0;

class HallDrawing {
 public:
  HallDrawing(const core::PlantDescription& plant, PicturePoints& points) : plant_(plant), points_(points) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::array<double, 2> low{kFar, kFar};
    std::array<double, 2> high{-kFar, -kFar};
    for (const RegionDescription& region : plant.regions) {
      for (std::size_t k = 0; k < region.x.size(); ++k) {
        low = {std::min(low[0], region.x[k]), std::min(low[1], region.y[k])};
        high = {std::max(high[0], region.x[k]), std::max(high[1], region.y[k])};
      }
    }
    scale_ = (kWidth - 2.0 * kMargin) / std::max(high[0] - low[0], 1.0);
    origin_x_ = kMargin - scale_ * low[0];
    origin_y_ = kMargin + scale_ * high[1];
    height_ = 2.0 * kMargin + scale_ * (high[1] - low[1]);
  }

  std::string draw() {
    out_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + units(kWidth) + " " + units(height_) +
           "\" data-floor-x=\"" + units(origin_x_) + "\" data-floor-y=\"" + units(origin_y_) +
           "\" data-floor-scale=\"" + units(scale_) + "\">\n<title>hall</title>\n";
    for (const RegionKind kind :
         {RegionKind::Wall, RegionKind::Place, RegionKind::Obstacle, RegionKind::Blockage}) {
      std::size_t number = 0;
      for (const RegionDescription& region : plant_.regions) {
        if (region.kind == kind) add_region(region, ++number);
      }
    }
    // The tractor last: it is above its trailers.
    for (std::size_t link = plant_.links.size(); link-- > 0;) add_link(plant_.links[link], link);
    return out_ + "</svg>\n";
  }

 private:
  // A region with its name in it; `live` is the binding of its outline.
  void add_region(const RegionDescription& region, std::size_t number) {
    const std::string n = std::to_string(number);
    switch (region.kind) {
      case RegionKind::Wall:
        return add_outline(region, "fill=\"var(--panel)\" stroke=\"var(--line-strong)\" stroke-width=\"3\"",
                           "");
      case RegionKind::Obstacle:
        return add_outline(region, "fill=\"var(--equipment)\" stroke=\"var(--line-strong)\"", "");
      case RegionKind::Place: {
        const std::string point = points_.terminal("place_" + n, region.live);
        add_outline(region, "fill=\"none\" stroke=\"var(--line)\" stroke-dasharray=\"4 3\"",
                    binding("data-on", point));
        return add_name(region);
      }
      case RegionKind::Blockage: {
        const std::string point = points_.truth("block_" + n, "block_" + n, "", false, region.live);
        return add_outline(region, "fill=\"var(--warn-soft)\" stroke=\"var(--warn)\" stroke-width=\"2\"",
                           binding("data-show", point));
      }
    }
  }

  static std::string binding(const char* kind, const std::string& point) {
    return point.empty() ? std::string() : " " + std::string(kind) + "=\"" + point + "\"";
  }

  void add_outline(const RegionDescription& region, const std::string& look, const std::string& live) {
    out_ += "<polygon points=\"";
    for (std::size_t k = 0; k < region.x.size(); ++k)
      out_ += (k == 0 ? "" : " ") + at_x(region.x[k]) + "," + at_y(region.y[k]);
    out_ += "\" " + look + live + ">";
    if (!region.name.empty()) out_ += "<title>" + markup::xml_escaped(region.name) + "</title>";
    out_ += "</polygon>\n";
  }

  // At its centre of area.
  void add_name(const RegionDescription& region) {
    double twice = 0.0;
    double x = 0.0;
    double y = 0.0;
    for (std::size_t k = 0; k < region.x.size(); ++k) {
      const std::size_t next = (k + 1) % region.x.size();
      // From the first corner, so that nothing is lost far from the origin.
      const double ax = region.x[k] - region.x[0];
      const double ay = region.y[k] - region.y[0];
      const double bx = region.x[next] - region.x[0];
      const double by = region.y[next] - region.y[0];
      const double part = ax * by - ay * bx;
      twice += part;
      x += part * (ax + bx) / 3.0;
      y += part * (ay + by) / 3.0;
    }
    if (twice == 0.0) return;
    out_ += "<text x=\"" + at_x(region.x[0] + x / twice) + "\" y=\"" + at_y(region.y[0] + y / twice) +
            "\" font-size=\"14\" text-anchor=\"middle\" fill=\"var(--text)\">" +
            markup::xml_escaped(region.name) + "</text>\n";
  }

  // Drawn around its middle, facing right.
  void add_link(const core::LinkDescription& link, std::size_t number) {
    const bool tractor = number == 0;
    const std::string id = tractor ? "tractor" : "trailer_" + std::to_string(number);
    const std::string pose = tractor ? measured_pose(id) : true_pose(id, link);
    std::string live;
    if (tractor) live = binding("data-alarm", points_.terminal(id + ".bumper", "bumper"));
    if (!tractor) {
      live = binding("data-show", points_.truth(id + ".state", link.name, "", false, link.state_truth));
      // One more than coupled is left standing.
      live += binding("data-warn", points_.add(id + ".left", link.name + " is left standing", "", false,
                                               {{PointSourceKind::PlantTruth, link.state_truth, 1.0, -1.0}}));
    }
    const double length = scale_ * link.length;
    const double width = scale_ * link.width;
    out_ += "<g" + pose + live + "><title>" + markup::xml_escaped(link.name) + "</title><rect x=\"" +
            units(-0.5 * length) + "\" y=\"" + units(-0.5 * width) + "\" width=\"" + units(length) +
            "\" height=\"" + units(width) + "\" fill=\"var(--" + (tractor ? "equipment-dark" : "equipment") +
            ")\" stroke=\"var(--line-strong)\"/>";
    // Where its front is.
    if (tractor) {
      out_ += "<path d=\"M" + units(0.1 * length) + " " + units(-0.35 * width) + "L" + units(0.4 * length) +
              " 0L" + units(0.1 * length) + " " + units(0.35 * width) + "Z\" fill=\"var(--line-strong)\"/>";
    }
    out_ += "</g>\n";
  }

  std::string measured_pose(const std::string& id) {
    return pose_binding(points_.counted(id + ".x", "m", "x", kHallCentimetre_m),
                        points_.counted(id + ".y", "m", "y", kHallCentimetre_m),
                        points_.counted(id + ".heading", "rad", "heading", kHallCentidegree_rad));
  }
  std::string true_pose(const std::string& id, const core::LinkDescription& link) {
    return pose_binding(
        points_.truth(id + ".x", link.name + ", x", "m", false, link.x_truth),
        points_.truth(id + ".y", link.name + ", y", "m", false, link.y_truth),
        points_.truth(id + ".heading", link.name + ", heading", "rad", false, link.heading_truth));
  }
  static std::string pose_binding(const std::string& x, const std::string& y, const std::string& heading) {
    if (x.empty() || y.empty()) return {};
    return binding("data-pose-x", x) + binding("data-pose-y", y) + binding("data-pose-heading", heading);
  }

  std::string at_x(double x_m) const { return units(origin_x_ + scale_ * x_m); }
  std::string at_y(double y_m) const { return units(origin_y_ - scale_ * y_m); }

  const core::PlantDescription& plant_;
  PicturePoints& points_;
  double scale_ = 1.0;  // units of a metre
  double origin_x_ = 0.0;
  double origin_y_ = 0.0;
  double height_ = 0.0;
  std::string out_;
};

}  // namespace

std::string hall_drawing(const core::PlantDescription& plant, PicturePoints& points) {
  return HallDrawing(plant, points).draw();
}

}  // namespace stepwright::hmi

#include "supervisor/fleet/mission/internal/floor_picture.h"

#include <algorithm>
#include <map>
#include <set>

#include "runtime/ground/markup/xml_text.h"
#include "supervisor/fleet/schedule/sections.h"

namespace stepwright::fleet::internal {

namespace {

using geometry::Point;

constexpr double kBorder_m = 2.0;  // around polygons where there is no map
constexpr double kTallest = 1.1;   // of the width
constexpr double kPathStep_m = 0.25;

}  // namespace

FloorPicture::FloorPicture(const FleetPlan& plan, const OccupancyGrid* map, double width, double left,
                           double top)
    : plan_(plan), map_(map), left_(left), top_(top) {
  geometry::Box extent{{1e9, 1e9}, {-1e9, -1e9}};  // finite where there is nothing to see
  if (map != nullptr) {
    const GridFrame& frame = map->frame();
    extend(extent, frame.corner({0, 0}));
    extend(extent, frame.corner({frame.columns, frame.rows}));
  } else {
    for (const VehicleMission& mission : plan.missions) {
      for (const EnvelopePolygon& polygon : mission.grown.envelope.polygons) {
        extend(extent, polygon.area.bounds().low - Point{kBorder_m, kBorder_m});
        extend(extent, polygon.area.bounds().high + Point{kBorder_m, kBorder_m});
      }
    }
  }
  low_ = extent.low;
  high_ = extent.high;
  const double width_m = std::max(high_.x_m - low_.x_m, 1e-3);
  const double height_m = std::max(high_.y_m - low_.y_m, 1e-3);
  scale_ = std::min(width / width_m, kTallest * width / height_m);
  height_ = scale_ * height_m;
}

std::string FloorPicture::outline(const geometry::ConvexPolygon& area) const {
  std::string text;
  for (const Point p : area.corners()) {
    text += fmt::format("{}{:.1f} {:.1f}", text.empty() ? "M" : "L", x(p.x_m), y(p.y_m));
  }
  return text + "Z";
}

// Blocked cells as rectangles: runs of a row, joined with equal runs of the rows above.
void FloorPicture::draw_walls(SvgPage& page) const {
  if (map_ == nullptr) return;
  const GridFrame& frame = map_->frame();
  page.print(
      "<rect class=\"floor\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n<path "
      "class=\"wall\" d=\"",
      x(low_.x_m), y(high_.y_m), scale_ * (high_.x_m - low_.x_m), scale_ * (high_.y_m - low_.y_m));
  using Run = std::pair<std::int32_t, std::int32_t>;
  std::map<Run, std::int32_t> open;  // and the row in which it began
  const auto close = [&](const Run& run, std::int32_t begin, std::int32_t end) {
    const Point corner = frame.corner({run.first, begin});
    const double wide = scale_ * frame.resolution_m * (run.second - run.first + 1);
    const double tall = scale_ * frame.resolution_m * (end - begin);
    page.print("M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z", x(corner.x_m), y(corner.y_m), wide, -tall, -wide);
  };
  for (std::int32_t row = 0; row <= frame.rows; ++row) {
    std::set<Run> here;
    for (std::int32_t column = 0; row < frame.rows && column < frame.columns; ++column) {
      if (!map_->blocked({column, row})) continue;
      std::int32_t last = column;
      while (last + 1 < frame.columns && map_->blocked({last + 1, row})) ++last;
      here.emplace(column, last);
      column = last;
    }
    for (auto run = open.begin(); run != open.end();) {
      if (here.contains(run->first)) {
        ++run;
        continue;
      }
      close(run->first, run->second, row);
      run = open.erase(run);
    }
    for (const Run& run : here) open.try_emplace(run, row);
  }
  page.print("\"/>\n");
}

void FloorPicture::draw_envelopes(SvgPage& page) const {
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    page.print("<path class=\"envelope\" style=\"--hue:{}\" d=\"", hue(v));
    for (const EnvelopePolygon& polygon : plan_.missions[v].grown.envelope.polygons) {
      page.print("{}", outline(polygon.area));
    }
    page.print("\"/>\n");
  }
}

// One path, so that what is shared by several pairs is no darker.
void FloorPicture::draw_sections(SvgPage& page) const {
  const auto envelopes = envelopes_of(plan_);
  page.print("<path class=\"section\" d=\"");
  for (const SpatialPair& pair : overlapping_pairs(envelopes)) {
    const auto both = intersection(envelopes[pair.a.vehicle].polygons[pair.a.polygon].area,
                                   envelopes[pair.b.vehicle].polygons[pair.b.polygon].area);
    if (both) page.print("{}", outline(*both));
  }
  page.print("\"/>\n");
}

void FloorPicture::draw_path(SvgPage& page, std::size_t vehicle) const {
  const geometry::Path& path = plan_.missions[vehicle].path;
  for (std::size_t k = 0; k + 1 < path.size();) {
    const geometry::Travel travel = path[k + 1].travel;
    page.print("<path class=\"{}\" style=\"--hue:{}\" d=\"M{:.1f} {:.1f}",
               travel == geometry::Travel::Forward ? "way" : "way back", hue(vehicle), x(path[k].pose.x_m),
               y(path[k].pose.y_m));
    double drawn_m = path[k].arc_m;
    while (k + 1 < path.size() && path[k + 1].travel == travel) {
      ++k;
      const bool ends = k + 1 == path.size() || path[k + 1].travel != travel;
      if (!ends && path[k].arc_m - drawn_m < kPathStep_m) continue;
      page.print("L{:.1f} {:.1f}", x(path[k].pose.x_m), y(path[k].pose.y_m));
      drawn_m = path[k].arc_m;
    }
    page.print("\"/>\n");
  }
}

// Where it begins filled, where it stops hollow; a line at the front says where it looks.
void FloorPicture::draw_vehicles(SvgPage& page) const {
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    const VehicleMission& mission = plan_.missions[v];
    if (mission.path.empty()) continue;
    draw_path(page, v);
    const auto stand = [&](const geometry::Pose& pose, const char* kind) {
      const geometry::Footprint outline_m = mission.model.footprint();
      const Point left = from_frame(pose, {0.55 * outline_m.front_m, 0.8 * outline_m.half_width_m});
      const Point tip = from_frame(pose, {0.9 * outline_m.front_m, 0.0});
      const Point right = from_frame(pose, {0.55 * outline_m.front_m, -0.8 * outline_m.half_width_m});
      page.print(
          "<path class=\"{}\" style=\"--hue:{}\" d=\"{}M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n",
          kind, hue(v), outline(footprint_at(pose, outline_m)), x(left.x_m), y(left.y_m), x(tip.x_m),
          y(tip.y_m), x(right.x_m), y(right.y_m));
    };
    for (const Stop& stop : mission.stops) stand(mission.path[stop.pose].pose, "stop");
    if (mission.stops.empty() && mission.path.size() > 1) stand(mission.path.back().pose, "stop");
    stand(mission.path.front().pose, "start");
  }
}

void FloorPicture::draw_names(SvgPage& page) const {
  std::map<std::string, Point> places;
  for (const VehicleMission& mission : plan_.missions) {
    for (const Stop& stop : mission.stops)
      places.emplace(stop.location, mission.path[stop.pose].pose.position());
  }
  for (const auto& [name, at] : places) {
    page.print("<text class=\"place m\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x(at.x_m), y(at.y_m) + 22.0,
               markup::xml_escaped(name));
  }
  for (std::size_t v = 0; v < plan_.missions.size(); ++v) {
    const VehicleMission& mission = plan_.missions[v];
    const Point at = mission.path.empty() ? mission.grown.envelope.polygons.front().area.centroid()
                                          : mission.path.front().pose.position();
    page.print("<text class=\"name m\" style=\"--hue:{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", hue(v),
               x(at.x_m), y(at.y_m) - 12.0, markup::xml_escaped(mission.vehicle));
  }
}

void FloorPicture::draw(SvgPage& page) const {
  draw_walls(page);
  draw_envelopes(page);
  draw_sections(page);
  draw_vehicles(page);
  draw_names(page);
}

}  // namespace stepwright::fleet::internal

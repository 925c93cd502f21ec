#pragma once

// The floor of a plan as SVG elements. See fleet_svg.h.

#include "supervisor/fleet/mission/internal/svg_page.h"
#include "supervisor/fleet/plan/fleet_plan.h"
#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet::internal {

class FloorPicture {
 public:
  // As wide as this, at the left and upper border `left` and `top`.
  FloorPicture(const FleetPlan& plan, const OccupancyGrid* map, double width, double left, double top);

  double height() const { return height_; }
  void draw(SvgPage& page) const;

 private:
  double x(double x_m) const { return left_ + scale_ * (x_m - low_.x_m); }
  double y(double y_m) const { return top_ + scale_ * (high_.y_m - y_m); }
  std::string outline(const geometry::ConvexPolygon& area) const;
  void draw_walls(SvgPage& page) const;
  void draw_envelopes(SvgPage& page) const;
  void draw_sections(SvgPage& page) const;
  void draw_vehicles(SvgPage& page) const;
  void draw_path(SvgPage& page, std::size_t vehicle) const;
  void draw_names(SvgPage& page) const;

  const FleetPlan& plan_;
  const OccupancyGrid* map_;
  double left_, top_;
  geometry::Point low_, high_;
  double scale_ = 1.0;
  double height_ = 0.0;
};

}  // namespace stepwright::fleet::internal

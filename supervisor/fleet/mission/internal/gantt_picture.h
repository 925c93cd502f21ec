#pragma once

// Picture of who is in which polygon when, as SVG elements. See fleet_svg.h.
//
// One thread; the plan outlives it.

#include "supervisor/fleet/mission/internal/svg_page.h"
#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet::internal {

class GanttPicture {
 public:
  GanttPicture(const FleetPlan& plan, double width, double left, double top);

  double height() const;
  void draw(SvgPage& page) const;

 private:
  double x(std::chrono::milliseconds time) const;
  void draw_axis(SvgPage& page) const;
  void draw_row(SvgPage& page, std::size_t vehicle) const;
  void draw_waits(SvgPage& page) const;

  const FleetPlan& plan_;
  double left_, top_, bars_, width_;
  std::chrono::milliseconds span_{1};
};

}  // namespace stepwright::fleet::internal

#pragma once

// The outlines that no link of a train may meet: border and obstacles of a floor as sides in a grid, with a
// lower bound of the distance to the nearest one for each cell, so that most questions are one look.
//
// A value that does not change; any thread may read. It knows sides only: a box that lies in an obstacle as a
// whole meets none, and gets there only through one.
//
//   const Walls walls(floor, model);
//   if (walls.meets(boxes[0])) ...

#include <cstdint>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"
#include "supervisor/ltl/regions/make_regions.h"
#include "supervisor/ltl/train/train_model.h"

namespace stepwright::ltl {

class Walls {
 public:
  // The size of boxes is that of the model's links. Requires outlines of finite points.
  Walls(const Floor& floor, const TrainModel& model);

  // Whether a side comes into the inside of the box.
  bool meets(const LinkBox& box) const;
  // Whether any of the train's links does.
  bool meet(const LinkBoxes& boxes, std::size_t links) const;
  // No side is nearer than this, which is near to the truth but far from all of them; 0 outside of the
  // border's bounds.
  double clearance_m(geometry::Point at) const;

 private:
  struct Side {
    geometry::Point from, to;
  };

  void add(const std::vector<geometry::Point>& ring);
  template <typename Visit>
  void each_cell(const Visit& visit) const;
  void sort_into_cells();
  void measure_cells();
  void measure_square(std::size_t row, std::size_t column, std::size_t cells,
                      const std::vector<std::uint32_t>& among);
  std::size_t column(double x_m) const;
  std::size_t row(double y_m) const;
  bool crosses(const Side& side, const LinkBox& box) const;

  double half_length_m_;
  double half_width_m_;
  double reach_m_;  // of a corner from the middle
  std::vector<Side> sides_;
  geometry::Box bounds_;
  double cell_m_ = 0.25;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::uint32_t> first_;  // of each cell among `inside_`, and the end
  std::vector<std::uint32_t> inside_;
  std::vector<double> clearance_m_;  // of all of a cell
};

}  // namespace stepwright::ltl

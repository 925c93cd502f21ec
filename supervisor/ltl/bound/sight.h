#pragma once

// Which points of a floor see each other, and which places the straight way between them leads through: the
// edges of a visibility graph (T. Lozano-Perez, M. Wesley 1979). A way along an outline, or through a corner,
// is free; between two outlines it is where they are more than 20 micrometres apart. Where it is not certain
// to a micrometre that something is in the way, nothing is: shortest ways over this graph are never too long.
//
// A value that does not change; any thread may read. Example:
//   const Sight sight(floor);
//   if (const auto through = sight.through(a, b)) ...   // the places on the way; nothing: it is blocked

#include <optional>
#include <vector>

#include "supervisor/geometry/box.h"
#include "supervisor/ltl/regions/make_regions.h"

namespace stepwright::ltl {

class Sight {
 public:
  // Requires a floor that make_regions() takes.
  explicit Sight(const Floor& floor);

  // Both ends within the free floor, or on its outlines. A place that the way only touches does not count.
  std::optional<Label> through(geometry::Point from, geometry::Point to) const;

  // Corners of obstacles, of the border and of places at which a shortest way may bend: they bulge towards
  // the free floor, and lie on it.
  const std::vector<geometry::Point>& corners() const { return corners_; }

 private:
  struct Outline {
    std::vector<geometry::Point> ring;
    geometry::Box bounds;
  };
  struct Way {
    geometry::Point from, to;
    geometry::Point along;  // of length 1
    double length_m = 0.0;
  };

  static Outline outline_of(const std::vector<geometry::Point>& ring);
  static bool apart(const Outline& outline, geometry::Point a, geometry::Point b);
  static bool lies_within(const Outline& outline, geometry::Point at, bool beyond);
  static bool cut(const Outline& outline, const Way& way, std::vector<double>& cuts_m);
  template <typename Open>
  static bool open_beside(const Way& way, std::vector<double>& cuts_m, const Open& open);
  bool is_free(geometry::Point at) const;
  void add_corners(const Outline& outline, bool hole);

  Outline border_;
  std::vector<Outline> obstacles_;
  std::vector<Outline> places_;
  std::vector<geometry::Point> corners_;
};

}  // namespace stepwright::ltl

#pragma once

// Which propositions hold at a point, and which letters a straight way reads: the propositions of a floor as
// outlines. Exact for whatever lies between the ends, so that no strip is too thin to be seen.
//
// A value that does not change; any thread may read. A point that an outline only touches is no letter of its
// own. Example:
//   const Places places(floor.propositions);
//   places.read({0, 0}, {5, 0}, letters);       // the labels after that of the first point, in their order

#include <span>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"
#include "supervisor/ltl/regions/make_regions.h"

namespace stepwright::ltl {

class Places {
 public:
  // Requires outlines that make_regions() takes.
  explicit Places(std::span<const Area> propositions);

  std::size_t size() const { return outlines_.size(); }
  std::span<const geometry::Point> outline(std::size_t k) const { return outlines_[k].ring; }

  Label label(geometry::Point at) const;
  // Appends each label of the way that differs from the one before it; returns the last one. `here` is the
  // label at `from`.
  Label read(geometry::Point from, geometry::Point to, Label here, std::vector<Label>& letters) const;
  // Those whose outline comes nearer to the way than that.
  Label near(geometry::Point from, geometry::Point to, double than_m) const;

 private:
  struct Outline {
    std::vector<geometry::Point> ring;
    geometry::Box bounds;
  };
  std::vector<Outline> outlines_;
};

// Even-odd rule.
bool inside(std::span<const geometry::Point> ring, geometry::Point at);

}  // namespace stepwright::ltl

#include "supervisor/tamp/intervals/program/reach_rings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "ladder/graphic/identifier.h"
#include "ladder/graphic/literal_text.h"

namespace stepwright::tamp {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSlack = 1e-9;  // of distances and bearings of a cell
constexpr double kDigit = 1e-6;  // of what is written

// A cell as it is seen from the shoulder.
struct Seen {
  double least_m = 0.0, most_m = 0.0;                // of the wrist
  double least_beside_m = 0.0, most_beside_m = 0.0;  // the same, seen from above
  std::optional<Arc> bearing;                        // nothing: it lies on all sides
};

class View {
 public:
  explicit View(const Shoulder& shoulder) : shoulder_(shoulder) {}

  Seen see(const Box& cell) const {
    std::array<double, 3> low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double from = shoulder_.at_m[axis] - (axis == 2 ? shoulder_.wrist_above_m : 0.0);
      low[axis] = metres_of(cell[axis].low_nm) - from - kSlack;
      high[axis] = metres_of(cell[axis].high_nm) - from + kSlack;
    }
    std::array<double, 3> near{}, far{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      near[axis] = std::max({low[axis], -high[axis], 0.0});
      far[axis] = std::max(-low[axis], high[axis]);
    }
    return {std::hypot(near[0], near[1], near[2]) - kSlack, std::hypot(far[0], far[1], far[2]) + kSlack,
            std::hypot(near[0], near[1]) - kSlack, std::hypot(far[0], far[1]) + kSlack, bearing(low, high)};
  }

 private:
  static std::optional<Arc> bearing(const std::array<double, 3>& low, const std::array<double, 3>& high) {
    if (low[0] <= 0.0 && high[0] >= 0.0 && low[1] <= 0.0 && high[1] >= 0.0) return std::nullopt;
    const double middle = std::atan2(low[1] + high[1], low[0] + high[0]);
    double least = 0.0, most = 0.0;
    for (const double x : {low[0], high[0]}) {
      for (const double y : {low[1], high[1]}) {
        const double turn = std::remainder(std::atan2(y, x) - middle, 2.0 * kPi);
        least = std::min(least, turn);
        most = std::max(most, turn);
      }
    }
    return arc_outward(middle + least - kSlack, middle + most + kSlack);
  }

  Shoulder shoulder_;
};

template <typename Visit>
void each_reached_cell(const ReachBounds& reach, Visit visit) {
  const ReachGrid& grid = reach.grid();
  for (std::int64_t z = 0; z < grid.cells[2]; ++z)
    for (std::int64_t y = 0; y < grid.cells[1]; ++y)
      for (std::int64_t x = 0; x < grid.cells[0]; ++x)
        if (const auto arcs = reach.arcs(grid.index(x, y, z)); !arcs.empty())
          visit(Box{grid.span(0, x), grid.span(1, y), grid.span(2, z)}, arcs);
}

// The two narrowest arcs that hold all of the set: its two widest gaps stay.
std::vector<Arc> two_of(const ArcSet& set) {
  std::vector<Arc> arcs(set.arcs().begin(), set.arcs().end());
  while (arcs.size() > 2) {
    std::size_t narrowest = 0;
    std::uint32_t gap = std::numeric_limits<std::uint32_t>::max();
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const std::uint32_t next = arcs[(k + 1) % arcs.size()].low - arcs[k].high();
      if (next < gap) {
        gap = next;
        narrowest = k;
      }
    }
    const std::size_t next = (narrowest + 1) % arcs.size();
    arcs[narrowest].width = arcs[next].high() - arcs[narrowest].low;
    arcs.erase(arcs.begin() + static_cast<std::ptrdiff_t>(next));
  }
  return arcs;
}

ReachRing ring_of(double least_m, double most_m, Arc arc) {
  const double width = static_cast<double>(arc.width) * (2.0 * kPi / 4294967296.0);
  if (arc.width == Arc::kFull) return {least_m, most_m, 0.0, kPi};
  return {least_m, most_m, radians_of(arc.low + arc.width / 2), 0.5 * width + kSlack};
}

// Six digits behind the point, rounded so that bounds do not shrink.
std::string down(double value) {
  return fmt::format("{:.6f}", std::floor(value / kDigit) * kDigit);
}
std::string up(double value) {
  return fmt::format("{:.6f}", std::ceil(value / kDigit) * kDigit);
}

}  // namespace

ReachRings rings_of(const ReachBounds& reach, const Shoulder& shoulder, std::size_t distances) {
  const View view(shoulder);
  ReachRings out;
  out.shoulder = shoulder;
  double least_m = 0.0, most_m = 0.0;  // seen from above
  bool any = false;
  each_reached_cell(reach, [&](const Box& cell, std::span<const Arc>) {
    const Seen seen = view.see(cell);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = metres_of(cell[axis].low_nm), high = metres_of(cell[axis].high_nm);
      out.low_m[axis] = any ? std::min(out.low_m[axis], low) : low;
      out.high_m[axis] = any ? std::max(out.high_m[axis], high) : high;
    }
    out.least_m = any ? std::min(out.least_m, seen.least_m) : seen.least_m;
    out.most_m = any ? std::max(out.most_m, seen.most_m) : seen.most_m;
    least_m = any ? std::min(least_m, seen.least_beside_m) : seen.least_beside_m;
    most_m = any ? std::max(most_m, seen.most_beside_m) : seen.most_beside_m;
    any = true;
  });
  if (!any) return out;
  out.least_m = std::max(out.least_m, 0.0);
  least_m = std::max(least_m, 0.0);
  std::vector<ArcSet> turns(distances);
  const double part_m = (most_m - least_m) / static_cast<double>(distances);
  const auto part_of = [&](double distance_m) {
    const double part = (distance_m - least_m) / part_m;
    return static_cast<std::size_t>(std::clamp(part, 0.0, static_cast<double>(distances - 1)));
  };
  each_reached_cell(reach, [&](const Box& cell, std::span<const Arc> arcs) {
    const Seen seen = view.see(cell);
    const ArcSet turned = seen.bearing ? difference_of(arcs, std::span(&*seen.bearing, 1)) : ArcSet::full();
    for (std::size_t k = part_of(seen.least_beside_m); k <= part_of(seen.most_beside_m); ++k)
      turns[k].add(turned.arcs());
  });
  for (std::size_t k = 0; k < distances; ++k) {
    const double from_m = least_m + part_m * static_cast<double>(k);
    for (const Arc arc : two_of(turns[k]))
      out.rings.push_back(ring_of(from_m - kSlack, from_m + part_m + kSlack, arc));
  }
  return out;
}

std::string reach_block(const std::string& arm, const ReachRings& rings) {
  std::string bounds;
  const auto member = [&](const char* key, const std::string& value) {
    bounds += fmt::format("{}{} := {}", bounds.empty() ? "" : ", ", key, value);
  };
  const Shoulder& shoulder = rings.shoulder;
  member("ShoulderX", graphic::real_literal(shoulder.at_m[0]));
  member("ShoulderY", graphic::real_literal(shoulder.at_m[1]));
  member("ShoulderZ", graphic::real_literal(shoulder.at_m[2]));
  member("WristAbove", graphic::real_literal(shoulder.wrist_above_m));
  member("Least", down(rings.least_m));
  member("Most", up(rings.most_m));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string key(1, "XYZ"[axis]);
    member(("Min" + key).c_str(), down(rings.low_m[axis]));
    member(("Max" + key).c_str(), up(rings.high_m[axis]));
  }
  member("Rings", std::to_string(rings.rings.size()));
  std::string list;
  for (const ReachRing& each : rings.rings) {
    list += fmt::format("{}\n      (MinDistance := {}, MaxDistance := {}, Middle := {:.6f}, Half := {})",
                        list.empty() ? "" : ",", down(each.least_m), up(each.most_m), each.middle_rad,
                        up(each.half_rad + kDigit));
  }
  if (!list.empty()) bounds += fmt::format(",\n    Ring := [{}]", list);
  return fmt::format(
      "(* Whether an arm can reach a pose: outside of these bounds nothing can be reached, within them\n"
      "   nothing is promised. The tool hangs down and is turned by Angle about the vertical; metres and "
      "radians,\n"
      "   in the frame of the planner's cell. *)\n"
      "FUNCTION_BLOCK {0}\n"
      "VAR_INPUT X, Y, Z, Angle : LREAL; END_VAR\n"
      "VAR_OUTPUT Ok : BOOL; Margin, AngleMargin : LREAL; Cause, Nearest : REACH_CAUSE; END_VAR\n"
      "VAR\n"
      "  bounds : REACH_BOUNDS := ({1});\n"
      "  check : REACH_CHECK;\n"
      "END_VAR\n"
      "  check(X := X, Y := Y, Z := Z, Angle := Angle, Bounds := bounds);\n"
      "  Ok := check.Ok;\n"
      "  Margin := check.Margin;\n"
      "  AngleMargin := check.AngleMargin;\n"
      "  Cause := check.Cause;\n"
      "  Nearest := check.Nearest;\n"
      "END_FUNCTION_BLOCK\n",
      graphic::make_identifier(arm + "_REACH"), bounds);
}

}  // namespace stepwright::tamp

#include "supervisor/tamp/intervals/cause/reached.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "supervisor/geometry/radical_inverse.h"

namespace stepwright::tamp {
namespace {

using geometry::radical_inverse;

constexpr std::size_t kAngles = 16, kPoints = 24;

// The angle at this part of all that the set has.
Angle angle_at(const ArcSet& set, double part) {
  auto left = static_cast<std::uint64_t>(part * static_cast<double>(set.units()));
  for (const Arc arc : set.arcs()) {
    if (left <= arc.width) return arc.low + static_cast<std::uint32_t>(left);
    left -= std::uint64_t{arc.width} + 1;
  }
  return set.arcs().back().high();
}

std::vector<Angle> angles_of(const ArcSet& set) {
  if (set.empty()) return {};
  if (set.units() == 1) return {set.arcs().front().low};
  std::vector<Angle> angles;
  for (std::size_t k = 1; k <= kAngles; ++k) angles.push_back(angle_at(set, radical_inverse(k, 2)));
  return angles;
}

// The middle, the corners, then points spread over the box.
std::vector<Point3> points_of(const Box& box) {
  const auto at = [&](double x, double y, double z) {
    const double parts[3] = {x, y, z};
    Point3 point;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[axis] = box[axis].low_nm + std::llround(parts[axis] * static_cast<double>(box[axis].width_nm()));
    return point;
  };
  std::vector<Point3> points{at(0.5, 0.5, 0.5)};
  for (const double z : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 1.0}) points.push_back(at(x, y, z));
  for (std::size_t k = 1; k <= kPoints; ++k)
    points.push_back(at(radical_inverse(k, 2), radical_inverse(k, 3), radical_inverse(k, 5)));
  std::vector<Point3> different;
  for (const Point3& each : points)
    if (std::ranges::find(different, each) == different.end()) different.push_back(each);
  return different;
}

class ReachedSearch {
 public:
  ReachedSearch(const WorkCell& cell, std::span<const Action> sequence, std::size_t most_questions)
      : cell_(cell), network_(cell), left_(most_questions) {
    for (const Action& action : sequence) network_.push(action);
  }

  std::optional<Witness> run() {
    if (network_.refuted() || !is_known()) return std::nullopt;
    std::vector<double> room;
    for (const Network::Visit& visit : network_.visits()) {
      room.push_back(room_of(visit));
      if (room.back() == 0.0) return std::nullopt;
      order_.push_back(static_cast<std::uint32_t>(order_.size()));
    }
    std::ranges::stable_sort(order_, {}, [&](std::uint32_t k) { return room[k]; });
    visit(0);
    return std::move(witness_);
  }

 private:
  const ExactReach* exact_of(const Network::Visit& visit) const {
    return cell_.arms[network_.constraints()[visit.constraint].arm].exact;
  }

  // A tool that is anywhere around the object's axis has no place to ask for.
  bool is_known() const {
    return std::ranges::all_of(network_.visits(), [&](const Network::Visit& each) {
      return exact_of(each) != nullptr && each.radius_nm == 0;
    });
  }

  static Point3 tool_at(const Network::Visit& visit, const Point3& spot) {
    return {spot[0], spot[1], spot[2] + visit.rise_nm};
  }

  const ArcSet& object_angles(const Network::Visit& visit) const {
    return network_.angle(network_.places()[visit.place].angle);
  }

  // How much of its place does, whatever else is chosen: where there is none, all of the search is in vain,
  // and where there is little, it begins.
  double room_of(const Network::Visit& visit) {
    const ArcSet tool = sum_of(object_angles(visit).arcs(), network_.angle(visit.hand).arcs());
    const std::vector<Point3> points = points_of(network_.box(network_.places()[visit.place].spot));
    double room = 0.0;
    for (const Point3& at : points) {
      if (!spend()) return 0.0;
      const ArcSet both = intersection_of(exact_of(visit)->near(tool_at(visit, at)).arcs(), tool.arcs());
      room += static_cast<double>(both.units()) / static_cast<double>(points.size());
    }
    return room;
  }

  bool spend() {
    if (left_ > 0) --left_;
    return left_ > 0;
  }

  // Takes the visits in their order: a point, the object's angle, the hand's.
  bool visit(std::uint32_t number) {
    if (number == network_.visits().size()) return take();
    const Network::Visit visit = network_.visits()[order_[number]];
    const std::uint32_t spot = network_.places()[visit.place].spot;
    for (const Point3& at : points_of(network_.box(spot))) {
      if (!spend()) return false;
      const std::size_t mark = network_.mark();
      for (std::uint32_t axis = 0; axis < 3; ++axis) network_.choose(3 * spot + axis, {at[axis], at[axis]});
      if (network_.propagate() && turn(number, visit, tool_at(visit, at))) return true;
      network_.undo(mark);
    }
    return false;
  }

  bool turn(std::uint32_t number, const Network::Visit& visit, const Point3& tool) {
    const ArcSet near = exact_of(visit)->near(tool);
    const AngleId place = network_.places()[visit.place].angle;
    const ArcSet turns = difference_of(near.arcs(), network_.angle(visit.hand).arcs());
    for (const Angle object : angles_of(intersection_of(network_.angle(place).arcs(), turns.arcs()))) {
      const std::size_t mark = network_.mark();
      network_.choose_angle(place, ArcSet::point(object));
      if (network_.propagate() && grasp(number, visit, tool, near, object)) return true;
      network_.undo(mark);
      if (left_ == 0) return false;
    }
    return false;
  }

  bool grasp(std::uint32_t number, const Network::Visit& visit, const Point3& tool, const ArcSet& near,
             Angle object) {
    const ArcSet turned = ArcSet::point(object);
    const ArcSet hands = difference_of(near.arcs(), turned.arcs());
    for (const Angle hand : angles_of(intersection_of(network_.angle(visit.hand).arcs(), hands.arcs()))) {
      if (!spend()) return false;
      if (!exact_of(visit)->reaches(tool, object + hand)) continue;
      const std::size_t mark = network_.mark();
      network_.choose_angle(visit.hand, ArcSet::point(hand));
      if (network_.propagate() && this->visit(number + 1)) return true;
      network_.undo(mark);
    }
    return false;
  }

  bool take() {
    if (!network_.point()) return false;
    Witness witness;
    for (std::uint32_t spot = 0; spot < network_.spots(); ++spot) {
      const Box box = network_.box(spot);
      witness.spots.push_back({box[0].low_nm, box[1].low_nm, box[2].low_nm});
    }
    for (AngleId k = 0; k < network_.angles(); ++k)
      witness.angles.push_back(network_.angle(k).arcs().front().low);
    witness_ = std::move(witness);
    return true;
  }

  const WorkCell& cell_;
  Network network_;
  std::size_t left_;
  std::vector<std::uint32_t> order_;  // of visits: those with the least room first
  std::optional<Witness> witness_;
};

}  // namespace

std::optional<Witness> reached(const WorkCell& cell, std::span<const Action> sequence,
                               std::size_t most_questions) {
  return ReachedSearch(cell, sequence, most_questions).run();
}

}  // namespace stepwright::tamp

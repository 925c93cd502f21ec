#include "supervisor/tamp/intervals/cause/nearest_value.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "supervisor/tamp/intervals/cause/witness.h"

namespace stepwright::tamp {
namespace {

constexpr double kRound_m = 1e-4;
constexpr double kRound_rad = std::numbers::pi / 1800.0;
constexpr double kFine_m = 1e-4;  // of distances, which are halved

bool is_angle(Parameter parameter) {
  return parameter == Parameter::StartAngle || parameter == Parameter::FinalAngle;
}

std::size_t axis_of(Parameter parameter) {
  if (parameter == Parameter::RegionX || parameter == Parameter::StartX) return 0;
  if (parameter == Parameter::RegionY || parameter == Parameter::StartY) return 1;
  return 2;
}

bool is_region(Parameter parameter) {
  return parameter == Parameter::RegionX || parameter == Parameter::RegionY ||
         parameter == Parameter::RegionHeight;
}

class NearestValue {
 public:
  NearestValue(const WorkCell& cell, std::span<const Action> sequence, Parameter parameter,
               std::size_t subject, std::size_t which, const CauseOptions& options)
      : cell_(cell),
        sequence_(sequence.begin(), sequence.end()),
        parameter_(parameter),
        subject_(subject),
        which_(which),
        options_(options),
        from_(value_of(cell, sequence, parameter, subject, which)) {}

  std::optional<double> find() {
    if (parameter_ == Parameter::Distance) return find_distance();
    return is_angle(parameter_) ? find_angle() : find_length();
  }

 private:
  bool does(double value) {
    ++questions_;
    set_value(cell_, sequence_, parameter_, subject_, which_, value);
    return solve(cell_, sequence_, {}, options_.most_nodes).answer == Answer::Feasible;
  }

  double rounded(double value, double unit) {
    const double steps = value / unit;
    const double further = unit * (value > from_ ? std::ceil(steps - 1e-6) : std::floor(steps + 1e-6));
    return further != value && does(further) ? further : value;
  }

  // Without what fixes the number: the network of everything else.
  Network freed() const {
    Network whole(cell_);
    for (const Action& action : sequence_) whole.push(action);
    std::vector<bool> dropped;
    for (const Constraint& each : whole.constraints()) dropped.push_back(fixes(each));
    Network network(cell_, {.dropped = std::move(dropped)});
    for (const Action& action : sequence_) network.push(action);
    return network;
  }

  bool fixes(const Constraint& each) const {
    switch (parameter_) {
      case Parameter::RegionX:
      case Parameter::RegionY:
        return each.kind == ConstraintKind::RegionArea && each.region == subject_;
      case Parameter::RegionHeight:
        return each.kind == ConstraintKind::RegionHeight && each.region == subject_;
      case Parameter::StartX:
      case Parameter::StartY:
        return each.kind == ConstraintKind::StartPosition && each.object == subject_;
      case Parameter::StartHeight:
        return each.kind == ConstraintKind::StartHeight && each.object == subject_;
      case Parameter::StartAngle:
        return each.kind == ConstraintKind::StartAngle && each.object == subject_;
      case Parameter::FinalAngle:
        return each.kind == ConstraintKind::FinalAngle && each.action == subject_;
      case Parameter::Distance:
        return false;
    }
    return false;
  }

  // The spots whose place the number fixes.
  std::vector<std::uint32_t> spots_of(const Network& network) const {
    std::vector<std::uint32_t> spots;
    for (std::size_t k = 0; k < sequence_.size(); ++k) {
      const std::uint32_t place = network.handlings()[k].place;
      if (place == Network::kNone) continue;
      const bool own = is_region(parameter_)
                           ? sequence_[k].kind == ActionKind::Place && sequence_[k].region == subject_
                           : sequence_[k].kind == ActionKind::Pick && sequence_[k].object == subject_;
      if (own) spots.push_back(network.places()[place].spot);
    }
    if (!is_region(parameter_) && spots.size() > 1) spots.resize(1);  // the first pick is from the start
    return spots;
  }

  std::optional<double> find_length() {
    const Network network = freed();
    if (network.refuted()) return std::nullopt;
    const std::size_t axis = axis_of(parameter_);
    const std::int64_t half_nm = half_size(axis);
    const std::int64_t from_nm = nanometres_of(from_);
    std::vector<std::int64_t> moves;
    for (const std::uint32_t spot : spots_of(network)) {
      const Span left = network.length(3 * spot + static_cast<LengthId>(axis));
      for (std::uint32_t v = network.last_visit(spot); v != Network::kNone; v = network.visit_before(v))
        add_moves(network.visits()[v], axis, left, {from_nm - half_nm, from_nm + half_nm}, moves);
    }
    std::ranges::sort(moves, {}, [](std::int64_t move) { return std::abs(move); });
    const auto again = std::ranges::unique(moves);
    moves.erase(again.begin(), again.end());
    for (const std::int64_t move : moves) {
      if (questions_ >= options_.most_questions) break;
      const double value = metres_of(from_nm + move);
      if (std::abs(value) < 0.9 * kFarthest_m && does(value)) return rounded(value, kRound_m);
    }
    return std::nullopt;
  }

  std::int64_t half_size(std::size_t axis) const {
    if (!is_region(parameter_) || axis == 2) return 0;
    const Region& region = cell_.regions[subject_];
    const double c = std::abs(std::cos(region.heading_rad)), s = std::abs(std::sin(region.heading_rad));
    return nanometres_of(0.5 * (axis == 0 ? c * region.size_x_m + s * region.size_y_m
                                          : s * region.size_x_m + c * region.size_y_m));
  }

  // By how much `now` is to be moved until it begins to touch another row of cells within `left`.
  static void add_moves(const Network::Visit& visit, std::size_t axis, Span left, Span now,
                        std::vector<std::int64_t>& moves) {
    const ReachGrid& grid = visit.reach->grid();
    const std::int64_t rise = axis == 2 ? visit.rise_nm : 0, radius = axis == 2 ? 0 : visit.radius_nm;
    const std::int64_t first = grid.row(axis, left.low_nm + rise - radius) - 1;
    const std::int64_t last = grid.row(axis, left.high_nm + rise + radius) + 1;
    for (std::int64_t row = first; row <= last; ++row) {
      const Span cell = grid.span(axis, row);
      // Edges of regions are rounded to a nanometre.
      const std::int64_t more = now.low_nm == now.high_nm ? 0 : 2;
      const std::int64_t up = cell.low_nm - rise - radius - now.high_nm + more;
      const std::int64_t down = cell.high_nm - rise + radius - now.low_nm - more;
      if (up > 0) moves.push_back(up);
      if (down < 0) moves.push_back(down);
    }
  }

  std::optional<double> find_angle() {
    const Network network = freed();
    if (network.refuted()) return std::nullopt;
    const std::uint32_t place = place_of_angle(network);
    if (place == Network::kNone) return std::nullopt;
    ArcSet left = network.angle(network.places()[place].angle);
    const Angle from = angle_of(from_);
    for (int tries = 0; tries < 64 && !left.empty(); ++tries) {
      const Angle at = left.nearest(from);
      // A hair inside, for the number is rounded to a unit again when it is read.
      const double value = from_ + turn_rad(from, at);
      if (does(value)) return rounded(value, kRound_rad);
      left = without(left, at);
    }
    return std::nullopt;
  }

  std::uint32_t place_of_angle(const Network& network) const {
    if (parameter_ == Parameter::FinalAngle) return network.handlings()[subject_].place;
    for (std::size_t k = 0; k < sequence_.size(); ++k)
      if (sequence_[k].kind == ActionKind::Pick && sequence_[k].object == subject_)
        return network.handlings()[k].place;
    return Network::kNone;
  }

  // Less a thousandth of a turn around an angle that will not do.
  static ArcSet without(const ArcSet& set, Angle at) {
    constexpr std::uint32_t kAround = 1u << 22;
    const ArcSet others = ArcSet::of({at + kAround, Arc::kFull - 2 * kAround});
    return intersection_of(set.arcs(), others.arcs());
  }

  // The less, the better; halved down to what people measure.
  std::optional<double> find_distance() {
    if (!does(0.0)) return std::nullopt;
    double low = 0.0, high = from_;
    while (high - low > kFine_m) {
      const double middle = 0.5 * (low + high);
      (does(middle) ? low : high) = middle;
    }
    return rounded(low, kRound_m);
  }

  WorkCell cell_;
  std::vector<Action> sequence_;
  Parameter parameter_;
  std::size_t subject_, which_;
  const CauseOptions& options_;
  double from_;
  std::size_t questions_ = 0;
};

double* number_of(WorkCell& cell, std::vector<Action>& sequence, Parameter parameter, std::size_t subject,
                  std::size_t which) {
  switch (parameter) {
    case Parameter::RegionX:
      return &cell.regions[subject].x_m;
    case Parameter::RegionY:
      return &cell.regions[subject].y_m;
    case Parameter::RegionHeight:
      return &cell.regions[subject].z_m;
    case Parameter::StartX:
      return &cell.objects[subject].start.x_m;
    case Parameter::StartY:
      return &cell.objects[subject].start.y_m;
    case Parameter::StartHeight:
      return &cell.objects[subject].start.z_m;
    case Parameter::StartAngle:
      return &cell.objects[subject].start.angle_rad;
    case Parameter::FinalAngle:
      return &*sequence[subject].final_angle_rad;
    case Parameter::Distance:
      return &sequence[subject].beyond[which].distance_m;
  }
  return nullptr;
}

}  // namespace

double value_of(const WorkCell& cell, std::span<const Action> sequence, Parameter parameter,
                std::size_t subject, std::size_t which) {
  WorkCell copy = cell;
  std::vector<Action> actions(sequence.begin(), sequence.end());
  return *number_of(copy, actions, parameter, subject, which);
}

void set_value(WorkCell& cell, std::vector<Action>& sequence, Parameter parameter, std::size_t subject,
               std::size_t which, double value) {
  *number_of(cell, sequence, parameter, subject, which) = value;
}

std::optional<double> nearest_value(const WorkCell& cell, std::span<const Action> sequence,
                                    Parameter parameter, std::size_t subject, std::size_t which,
                                    const CauseOptions& options) {
  return NearestValue(cell, sequence, parameter, subject, which, options).find();
}

}  // namespace stepwright::tamp

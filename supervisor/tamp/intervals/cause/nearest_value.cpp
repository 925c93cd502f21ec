#include "supervisor/tamp/intervals/cause/nearest_value.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "supervisor/tamp/intervals/cause/reached.h"
#include "supervisor/tamp/intervals/cause/witness.h"

namespace stepwright::tamp {
namespace {

constexpr double kRound_m = 1e-4;
constexpr double kRound_rad = std::numbers::pi / 1800.0;
constexpr double kFine_m = 1e-4;  // of distances, which are halved
constexpr double kStep_m = 5e-3;  // between poses that are asked of the arms
constexpr double kStep_rad = std::numbers::pi / 180.0;
constexpr std::size_t kMostRefused = 8;  // of values that arms reach, by whoever else is asked

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

class ValueSearch {
 public:
  ValueSearch(const WorkCell& cell, std::span<const Action> sequence, Parameter parameter,
              std::size_t subject, std::size_t which, const CauseOptions& options)
      : cell_(cell),
        sequence_(sequence.begin(), sequence.end()),
        parameter_(parameter),
        subject_(subject),
        which_(which),
        options_(options),
        from_(value_of(cell, sequence, parameter, subject, which)) {}

  std::optional<NearestValue> find() {
    if (parameter_ == Parameter::Distance) return find_distance();
    return is_angle(parameter_) ? find_angle() : find_length();
  }

 private:
  // By bounds: what does not do is proved not to.
  bool does(double value) {
    ++questions_;
    set(value);
    return solve(cell_, sequence_, {}, options_.most_nodes).answer == Answer::Feasible;
  }

  // By the arms: what holds is proved to do.
  bool holds(double value) {
    constexpr std::size_t kOfEach = 500;
    ++proofs_;
    set(value);
    return std::abs(value) < 0.9 * kFarthest_m && reached(cell_, sequence_, kOfEach).has_value();
  }

  void set(double value) { set_value(cell_, sequence_, parameter_, subject_, which_, value); }

  bool is_known() const {
    return options_.prove && std::ranges::all_of(sequence_, [&](const Action& each) {
             return each.kind == ActionKind::MoveAway || cell_.arms[each.arm].exact != nullptr;
           });
  }

  bool is_left() const {
    return questions_ < options_.most_questions && proofs_ < options_.most_proofs && refused_ < kMostRefused;
  }

  double unit() const { return is_angle(parameter_) ? kRound_rad : kRound_m; }

  // Away from the present value.
  double rounded(double value) const {
    const double steps = value / unit();
    return unit() * (value > from_ ? std::ceil(steps - 1e-6) : std::floor(steps + 1e-6));
  }

  NearestValue bound(double value) {
    const double further = rounded(value);
    return {further != value && does(further) ? further : value, false};
  }

  bool accepts() const { return !options_.accepts || options_.accepts(cell_, sequence_); }

  // Between what was refused and what was accepted, as far as that is worth a question.
  double nearer_accepted(double accepted) {
    double refused = last_refused_;
    const double step = is_angle(parameter_) ? kStep_rad : kStep_m;
    while (std::abs(accepted - refused) > 2.0 * step) {
      const double middle = rounded(0.5 * (accepted + refused));
      (holds(middle) && accepts() ? accepted : refused) = middle;
    }
    return accepted;
  }

  // What holds, nearest to one that does not; and nobody else refuses it.
  std::optional<double> proved_between(double without, double with) {
    while (std::abs(with - without) > 0.5 * unit()) {
      const double middle = 0.5 * (without + with);
      (holds(middle) ? with : without) = middle;
    }
    // What people read and write has so many digits, and must hold as they do.
    const double away = with > from_ ? unit() : -unit();
    for (int k = 0; k < 3; ++k) {
      const double written = rounded(with + k * away);
      if (!holds(written)) continue;
      if (accepts()) return refused_ == 0 ? written : nearer_accepted(written);
      ++refused_;
      last_refused_ = written;
      // Twice as far on from time to time: whatever is in the way has its own size.
      const double step = is_angle(parameter_) ? kStep_rad : kStep_m;
      beyond_ = std::abs(written - from_) + step * std::exp2(static_cast<double>(refused_ - 1));
      break;
    }
    return std::nullopt;
  }

  // From `first`, which the bounds allow, on to `last`.
  std::optional<double> proved_from(double first, double last) {
    const double step = is_angle(parameter_) ? kStep_rad : kStep_m;
    const int steps = static_cast<int>(std::ceil(std::abs(last - first) / step));
    std::optional<double> without;
    for (int k = 0; k <= steps && is_left(); ++k) {
      const double value = steps == 0 ? first : first + (last - first) * k / steps;
      if (std::abs(value - from_) < beyond_) continue;
      if (!holds(value)) {
        without = value;
        continue;
      }
      if (const auto proved = proved_between(without.value_or(value), value)) return proved;
      without.reset();
    }
    return std::nullopt;
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

  bool is_subject(const std::optional<std::size_t>& region) const {
    return region && cell_.regions[*region].name == cell_.regions[subject_].name;
  }

  bool fixes(const Constraint& each) const {
    switch (parameter_) {
      case Parameter::RegionX:
      case Parameter::RegionY:
        return each.kind == ConstraintKind::RegionArea && is_subject(each.region);
      case Parameter::RegionHeight:
        return each.kind == ConstraintKind::RegionHeight && is_subject(each.region);
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
                           ? sequence_[k].kind == ActionKind::Place && is_subject(sequence_[k].region)
                           : sequence_[k].kind == ActionKind::Pick && sequence_[k].object == subject_;
      if (own) spots.push_back(network.places()[place].spot);
    }
    if (!is_region(parameter_) && spots.size() > 1) spots.resize(1);  // the first pick is from the start
    return spots;
  }

  std::optional<NearestValue> find_length() {
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
    return nearest_of(moves, from_nm);
  }

  // Between two moves in one direction the bounds stay as they are.
  std::optional<NearestValue> nearest_of(const std::vector<std::int64_t>& moves, std::int64_t from_nm) {
    std::optional<double> allowed, proved;
    for (std::size_t k = 0; k < moves.size() && is_left(); ++k) {
      const double value = metres_of(from_nm + moves[k]);
      if (proved && std::abs(*proved - from_) <= std::abs(value - from_)) break;
      if (std::abs(value) >= 0.9 * kFarthest_m || !does(value)) continue;
      if (!allowed) allowed = value;
      if (!is_known()) break;
      const auto next = std::find_if(moves.begin() + static_cast<std::ptrdiff_t>(k) + 1, moves.end(),
                                     [&](std::int64_t move) { return (move > 0) == (moves[k] > 0); });
      const double end = next == moves.end() ? value : metres_of(from_nm + *next);
      if (const auto found = proved_from(value, end))
        if (!proved || std::abs(*found - from_) < std::abs(*proved - from_)) proved = found;
    }
    if (proved) return NearestValue{*proved, true};
    if (allowed) return bound(*allowed);
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

  std::optional<NearestValue> find_angle() {
    const Network network = freed();
    if (network.refuted()) return std::nullopt;
    const std::uint32_t place = place_of_angle(network);
    if (place == Network::kNone) return std::nullopt;
    ArcSet left = network.angle(network.places()[place].angle);
    const Angle from = angle_of(from_);
    std::optional<double> allowed;
    for (int tries = 0; tries < 512 && !left.empty() && is_left(); ++tries) {
      const Angle at = left.nearest(from);
      // A hair inside, for the number is rounded to a unit again when it is read.
      const double value = from_ + turn_rad(from, at);
      left = without(left, at);
      if (!does(value)) continue;
      if (!allowed) allowed = value;
      if (!is_known()) break;
      const double turn = value > from_ ? kStep_rad : -kStep_rad;
      if (const auto proved = proved_from(value, value + 0.5 * turn)) return NearestValue{*proved, true};
    }
    if (allowed) return bound(*allowed);
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
  std::optional<NearestValue> find_distance() {
    if (!does(0.0)) return std::nullopt;
    double low = 0.0, high = from_;
    while (high - low > kFine_m) {
      const double middle = 0.5 * (low + high);
      (does(middle) ? low : high) = middle;
    }
    if (is_known())
      if (const auto proved = proved_from(low, 0.0)) return NearestValue{*proved, true};
    return bound(low);
  }

  WorkCell cell_;
  std::vector<Action> sequence_;
  Parameter parameter_;
  std::size_t subject_, which_;
  const CauseOptions& options_;
  double from_;
  std::size_t questions_ = 0, proofs_ = 0, refused_ = 0;
  double last_refused_ = 0.0;
  double beyond_ = 0.0;  // from the present value: nearer ones were refused
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
  double& number = *number_of(cell, sequence, parameter, subject, which);
  const double change = value - number;
  number = value;
  // One surface may be several regions, a smaller one for each larger thing.
  if (!is_region(parameter)) return;
  for (std::size_t k = 0; k < cell.regions.size(); ++k)
    if (k != subject && cell.regions[k].name == cell.regions[subject].name)
      *number_of(cell, sequence, parameter, k, which) += change;
}

std::optional<NearestValue> nearest_value(const WorkCell& cell, std::span<const Action> sequence,
                                          Parameter parameter, std::size_t subject, std::size_t which,
                                          const CauseOptions& options) {
  return ValueSearch(cell, sequence, parameter, subject, which, options).find();
}

}  // namespace stepwright::tamp

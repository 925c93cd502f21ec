#include "tests/support/tamp/certificate_check.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <map>
#include <set>

namespace stepwright::tamp::testing {
namespace {

using Rational = boost::multiprecision::cpp_rational;

constexpr std::int64_t kTurn = std::int64_t{1} << 32;
constexpr double kWholeTurn_rad = 6.28318530717958647692;

// Sorted pieces [low, high] of 0 to 2^32 - 1, with gaps between them.
class Pieces {
 public:
  static Pieces all() { return Pieces({{0, kTurn - 1}}); }
  static Pieces of(std::span<const Arc> arcs) {
    Pieces pieces;
    for (const Arc arc : arcs) pieces.add(arc.low, std::int64_t{arc.low} + arc.width);
    pieces.tidy();
    return pieces;
  }

  bool empty() const { return list_.empty(); }
  bool within(const Pieces& other) const { return intersection(other).list_ == list_; }
  Pieces intersection(const Pieces& other) const {
    Pieces both;
    for (const auto& [a, b] : list_)
      for (const auto& [c, d] : other.list_)
        if (std::max(a, c) <= std::min(b, d)) both.list_.emplace_back(std::max(a, c), std::min(b, d));
    both.tidy();
    return both;
  }
  Pieces minus(const Pieces& other) const {
    Pieces result;
    for (const auto& [a, b] : list_) {
      for (const auto& [c, d] : other.list_) {
        const std::int64_t width = std::min(b - a + d - c, kTurn - 1);
        const std::int64_t low = ((a - d) % kTurn + kTurn) % kTurn;
        result.add(low, low + width);
      }
    }
    result.tidy();
    return result;
  }
  void join(const Pieces& other) {
    list_.insert(list_.end(), other.list_.begin(), other.list_.end());
    tidy();
  }
  bool contains(std::int64_t at) const {
    return std::ranges::any_of(list_,
                               [&](const auto& piece) { return piece.first <= at && at <= piece.second; });
  }

 private:
  using List = std::vector<std::pair<std::int64_t, std::int64_t>>;
  Pieces() = default;
  explicit Pieces(List list) : list_(std::move(list)) {}
  friend class SpotCheck;

  void add(std::int64_t low, std::int64_t high) {
    if (high < kTurn) return list_.emplace_back(low, high), void();
    list_.emplace_back(low, kTurn - 1);
    list_.emplace_back(0, std::min(high - kTurn, kTurn - 1));
  }
  void tidy() {
    std::ranges::sort(list_);
    List joined;
    for (const auto& piece : list_) {
      if (!joined.empty() && piece.first <= joined.back().second + 1)
        joined.back().second = std::max(joined.back().second, piece.second);
      else
        joined.push_back(piece);
    }
    list_ = std::move(joined);
  }

  List list_;
};

std::int64_t nanometres(double m) {
  return std::llround(m * 1e9);
}

// All that a checker knows: it starts with everything and believes a step after it has looked.
struct Known {
  std::vector<Span> lengths;
  std::vector<Pieces> angles;
};

// What is left of a spot, cell by cell.
class SpotCheck {
 public:
  SpotCheck(const Network& network, const Known& known, std::uint32_t spot)
      : network_(network), known_(known), spot_(spot) {
    for (std::uint32_t v = 0; v < network.visits().size(); ++v)
      if (network.places()[network.visits()[v].place].spot == spot) visits_.push_back(network.visits()[v]);
    run();
  }

  bool any = false;
  Span hull[3];
  std::map<AngleId, Pieces> left;

 private:
  // Where a cell of some visit begins, between the ends of what is known.
  std::vector<Span> slices(std::uint32_t axis) const {
    const Span span = known_.lengths[3 * spot_ + axis];
    std::set<std::int64_t> begins{span.low_nm};
    for (const Network::Visit& visit : visits_) {
      const ReachGrid& grid = visit.reach->grid();
      for (std::int64_t row = 0; row <= grid.cells[axis]; ++row) {
        const std::int64_t at =
            grid.origin_nm[axis] + row * grid.step_nm[axis] - (axis == 2 ? visit.rise_nm : 0);
        if (at > span.low_nm && at <= span.high_nm) begins.insert(at);
      }
    }
    std::vector<Span> all;
    for (auto begin = begins.begin(); begin != begins.end(); ++begin) {
      const auto next = std::next(begin);
      all.push_back({*begin, next == begins.end() ? span.high_nm : *next - 1});
    }
    return all;
  }

  Pieces reached(const Network::Visit& visit, Span x, Span y, Span z) const {
    const ReachGrid& grid = visit.reach->grid();
    Pieces all = Pieces::of({});
    const auto touches = [&](std::size_t axis, std::int64_t row, Span span) {
      const std::int64_t low = grid.origin_nm[axis] + row * grid.step_nm[axis];
      return low <= span.high_nm && span.low_nm < low + grid.step_nm[axis];
    };
    const Span wide_x{x.low_nm - visit.radius_nm, x.high_nm + visit.radius_nm};
    const Span wide_y{y.low_nm - visit.radius_nm, y.high_nm + visit.radius_nm};
    const Span high_z{z.low_nm + visit.rise_nm, z.high_nm + visit.rise_nm};
    const auto first = [&](std::size_t axis, Span span) {
      return std::max<std::int64_t>((span.low_nm - grid.origin_nm[axis]) / grid.step_nm[axis] - 1, 0);
    };
    for (std::int64_t c = first(2, high_z); c < grid.cells[2] && touches_or_before(grid, 2, c, high_z); ++c) {
      if (!touches(2, c, high_z)) continue;
      for (std::int64_t b = first(1, wide_y); b < grid.cells[1] && touches_or_before(grid, 1, b, wide_y);
           ++b) {
        if (!touches(1, b, wide_y)) continue;
        for (std::int64_t a = first(0, wide_x); a < grid.cells[0] && touches_or_before(grid, 0, a, wide_x);
             ++a)
          if (touches(0, a, wide_x)) all.join(Pieces::of(visit.reach->arcs(grid.index(a, b, c))));
      }
    }
    return all;
  }

  static bool touches_or_before(const ReachGrid& grid, std::size_t axis, std::int64_t row, Span span) {
    return grid.origin_nm[axis] + row * grid.step_nm[axis] <= span.high_nm;
  }

  void run() {
    const auto xs = slices(0), ys = slices(1), zs = slices(2);
    for (const Span z : zs)
      for (const Span y : ys)
        for (const Span x : xs) look(x, y, z);
  }

  void look(Span x, Span y, Span z) {
    std::map<AngleId, Pieces> here;
    std::vector<Pieces> reach;
    for (const Network::Visit& visit : visits_) {
      const AngleId object = network_.places()[visit.place].angle;
      reach.push_back(reached(visit, x, y, z));
      const auto [at, is_new] = here.try_emplace(object, known_.angles[object]);
      at->second = at->second.intersection(reach.back().minus(known_.angles[visit.hand]));
      if (at->second.empty()) return;
    }
    const Span slices[3] = {x, y, z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      hull[axis].low_nm = any ? std::min(hull[axis].low_nm, slices[axis].low_nm) : slices[axis].low_nm;
      hull[axis].high_nm = any ? std::max(hull[axis].high_nm, slices[axis].high_nm) : slices[axis].high_nm;
    }
    any = true;
    for (const auto& [angle, pieces] : here)
      left.try_emplace(angle, Pieces::of({})).first->second.join(pieces);
    for (std::size_t v = 0; v < visits_.size(); ++v) {
      const Pieces turned = reach[v].minus(here.at(network_.places()[visits_[v].place].angle));
      left.try_emplace(visits_[v].hand, Pieces::of({}))
          .first->second.join(known_.angles[visits_[v].hand].intersection(turned));
    }
  }

  const Network& network_;
  const Known& known_;
  std::uint32_t spot_;
  std::vector<Network::Visit> visits_;
};

Rational exact(double value) {
  return Rational(value);
}

class CertificateCheck {
 public:
  CertificateCheck(const Network& network, const std::vector<bool>& dropped)
      : network_(network), dropped_(dropped) {
    const std::int64_t far = nanometres(kFarthest_m);
    known_.lengths.assign(3 * network.spots(), Span{-far, far});
    known_.angles.assign(network.angles(), Pieces::all());
  }

  std::string run(const Certificate& certificate) {
    for (std::size_t k = 0; k < certificate.steps.size(); ++k) {
      const Step& step = certificate.steps[k];
      if (std::string wrong = look(step); !wrong.empty())
        return "step " + std::to_string(k + 1) + ": " + wrong;
      believe(step);
      if (step.is_conflict()) return "";
    }
    return sum(certificate.multipliers);
  }

 private:
  bool counts(ConstraintId id) const { return id >= dropped_.size() || !dropped_[id]; }

  void believe(const Step& step) {
    if (step.is_angle)
      known_.angles[step.variable] = known_.angles[step.variable].intersection(Pieces::of(step.arcs.arcs()));
    else
      known_.lengths[step.variable] = meet_of(known_.lengths[step.variable], step.span);
  }
  static Span meet_of(Span a, Span b) {
    return {std::max(a.low_nm, b.low_nm), std::min(a.high_nm, b.high_nm)};
  }
  static bool lies_in(Span a, Span b) {
    return a.low_nm > a.high_nm || (b.low_nm <= a.low_nm && a.high_nm <= b.high_nm);
  }

  std::string look(const Step& step) {
    switch (step.kind) {
      case StepKind::Given:
        return look_given(step);
      case StepKind::Spot:
        return look_spot(step);
      case StepKind::Row:
        return look_row(step);
      case StepKind::Chosen:
        return "a choice is no proof";
    }
    return "of no kind";
  }

  std::string look_given(const Step& step) {
    if (!counts(step.subject)) return "a dropped constraint";
    const Constraint& each = network_.constraints()[step.subject];
    if (step.is_angle) {
      const Pieces says = says_of_angle(each);
      if (angle_of_constraint(each) != step.variable) return "another angle";
      return known_.angles[step.variable].intersection(says).within(Pieces::of(step.arcs.arcs()))
                 ? ""
                 : "an angle is lost";
    }
    if (length_of_constraint(each) != step.variable / 3) return "another spot";
    const Span says = says_of_length(each, step.variable % 3);
    return lies_in(meet_of(known_.lengths[step.variable], says), step.span) ? "" : "a length is lost";
  }

  AngleId angle_of_constraint(const Constraint& each) const {
    const Network::Handling& handling = network_.handlings()[each.action];
    if (each.kind == ConstraintKind::GraspAngles) return handling.hand;
    if (each.kind == ConstraintKind::FinalAngle) return network_.places()[handling.place].angle;
    return network_.places()[start_place(each.object)].angle;
  }
  std::uint32_t start_place(std::size_t object) const {
    for (std::uint32_t k = 0; k < network_.places().size(); ++k)
      if (network_.places()[k].object == object) return k;
    return Network::kNone;
  }
  std::uint32_t length_of_constraint(const Constraint& each) const {
    const bool is_region =
        each.kind == ConstraintKind::RegionArea || each.kind == ConstraintKind::RegionHeight;
    const std::uint32_t place =
        is_region ? network_.handlings()[each.action].place : start_place(each.object);
    return network_.places()[place].spot;
  }

  // Units of an angle to one more on both sides, and half a unit to the nearest for a single one.
  Pieces says_of_angle(const Constraint& each) const {
    const auto unit = [](double rad) { return rad / kWholeTurn_rad * static_cast<double>(kTurn); };
    const auto point = [&](double rad) {
      const auto at = static_cast<std::int64_t>(std::llround(unit(rad)));
      return Pieces::of(std::vector{Arc{static_cast<Angle>(at), 0}});
    };
    const Action& action = network_.actions()[each.action];
    if (each.kind == ConstraintKind::FinalAngle) return point(*action.final_angle_rad);
    if (each.kind == ConstraintKind::StartAngle)
      return point(network_.cell().objects[each.object].start.angle_rad);
    if (each.kind != ConstraintKind::GraspAngles) return Pieces::all();
    Pieces says = Pieces::of({});
    for (const AngleRange range : network_.cell().grasps[action.grasp].angles) {
      const auto low = static_cast<std::int64_t>(std::ceil(unit(range.low_rad)));
      const auto high = static_cast<std::int64_t>(std::floor(unit(range.high_rad)));
      if (high < low) continue;
      says.join(Pieces::of(
          std::vector{Arc{static_cast<Angle>(low),
                          static_cast<std::uint32_t>(std::min<std::int64_t>(high - low, kTurn - 1))}}));
    }
    return says;
  }

  Span says_of_length(const Constraint& each, std::uint32_t axis) const {
    const std::int64_t far = nanometres(kFarthest_m);
    const auto at = [](double m) { return Span{nanometres(m), nanometres(m)}; };
    const ObjectPose& start = network_.cell().objects[each.object].start;
    if (each.kind == ConstraintKind::StartPosition && axis < 2) return at(axis == 0 ? start.x_m : start.y_m);
    if (each.kind == ConstraintKind::StartHeight && axis == 2) return at(start.z_m);
    if (!each.region) return {-far, far};
    const Region& region = network_.cell().regions[*each.region];
    if (each.kind == ConstraintKind::RegionHeight && axis == 2) return at(region.z_m);
    if (each.kind != ConstraintKind::RegionArea || axis == 2) return {-far, far};
    const double c = std::abs(std::cos(region.heading_rad)), s = std::abs(std::sin(region.heading_rad));
    const double half = axis == 0 ? 0.5 * (c * region.size_x_m + s * region.size_y_m)
                                  : 0.5 * (s * region.size_x_m + c * region.size_y_m);
    const double middle = axis == 0 ? region.x_m : region.y_m;
    return {nanometres(middle - half), nanometres(middle + half)};
  }

  std::string look_spot(const Step& step) {
    const SpotCheck check(network_, known_, step.subject);
    if (!check.any) return "";  // nothing is left: any claim is true
    if (!step.is_angle) {
      if (step.variable / 3 != step.subject) return "";  // nothing is claimed of this spot
      return lies_in(check.hull[step.variable % 3], step.span) ? "" : "a position is lost";
    }
    const auto left = check.left.find(step.variable);
    if (left == check.left.end()) return "an angle of another spot";
    return left->second.within(Pieces::of(step.arcs.arcs())) ? "" : "an angle is lost";
  }

  std::string look_row(const Step& step) {
    const LinearRow& row = network_.rows()[step.subject];
    if (!counts(row.constraint)) return "a dropped row";
    Rational rest = exact(row.high_nm), factor = 0;
    for (const LinearRow::Term& term : row.terms) {
      if (term.length == step.variable) {
        factor = exact(term.factor);
        continue;
      }
      rest -= least(exact(term.factor), known_.lengths[term.length]);
    }
    if (factor == 0) return "a row without the variable";
    const Rational bound = rest / factor;
    const Span before = known_.lengths[step.variable];
    // What is outside of the claim must be outside of the bound.
    if (factor > 0) {
      if (step.span.low_nm > before.low_nm && !step.is_conflict()) return "the wrong side";
      const std::int64_t claimed = step.is_conflict() ? before.low_nm - 1 : step.span.high_nm;
      return bound < Rational(claimed + 1) || claimed >= before.high_nm ? "" : "a position is lost";
    }
    if (step.span.high_nm < before.high_nm && !step.is_conflict()) return "the wrong side";
    const std::int64_t claimed = step.is_conflict() ? before.high_nm + 1 : step.span.low_nm;
    return bound > Rational(claimed - 1) || claimed <= before.low_nm ? "" : "a position is lost";
  }

  static Rational least(const Rational& factor, Span span) {
    return factor * Rational(factor > 0 ? span.low_nm : span.high_nm);
  }

  std::string sum(const std::vector<double>& multipliers) const {
    if (multipliers.size() != network_.rows().size() || multipliers.empty()) return "there is no conflict";
    std::map<LengthId, Rational> factors;
    Rational high = 0;
    for (std::size_t r = 0; r < multipliers.size(); ++r) {
      if (multipliers[r] < 0.0) return "a multiplier below 0";
      if (multipliers[r] == 0.0) continue;
      if (!counts(network_.rows()[r].constraint)) return "a dropped row";
      high += exact(multipliers[r]) * exact(network_.rows()[r].high_nm);
      for (const LinearRow::Term& term : network_.rows()[r].terms)
        factors[term.length] += exact(multipliers[r]) * exact(term.factor);
    }
    Rational most_left = 0;
    for (const auto& [length, factor] : factors) most_left += least(factor, known_.lengths[length]);
    return most_left > high ? "" : "the sum of rows has a point";
  }

  const Network& network_;
  const std::vector<bool>& dropped_;
  Known known_;
};

}  // namespace

std::string wrong_with(const Network& network, const Certificate& certificate,
                       const std::vector<bool>& dropped) {
  return CertificateCheck(network, dropped).run(certificate);
}

std::string wrong_with(const Network& network, const Witness& witness, const std::vector<bool>& dropped) {
  const WorkCell& cell = network.cell();
  const auto tool_at = [&](const Network::Visit& visit) {
    Point3 at = witness.spots[network.places()[visit.place].spot];
    at[2] += visit.rise_nm;
    return at;
  };
  for (const Network::Visit& visit : network.visits()) {
    if (visit.radius_nm > 0) continue;
    const Point3 at = tool_at(visit);
    const Angle angle = witness.angles[network.places()[visit.place].angle] + witness.angles[visit.hand];
    if (!Pieces::of(visit.reach->arcs_at(at)).contains(angle)) return "a tool is out of reach";
  }
  for (ConstraintId k = 0; k < network.constraints().size(); ++k) {
    if (k < dropped.size() && dropped[k]) continue;
    const Constraint& each = network.constraints()[k];
    const Network::Handling& handling = network.handlings()[each.action];
    const auto place_of = [&](std::uint32_t place) { return network.places()[place]; };
    const Point3 at =
        handling.place == Network::kNone ? Point3{} : witness.spots[place_of(handling.place).spot];
    const auto near = [](std::int64_t a, double m) { return std::abs(a - nanometres(m)) <= 10; };
    const auto turned = [&](Angle angle, double rad) {
      return std::abs(turn_rad(angle, angle_of(rad))) < 1e-8;
    };
    if (each.region) {
      const Region& region = cell.regions[*each.region];
      if (each.kind == ConstraintKind::RegionHeight && !near(at[2], region.z_m))
        return "not at the region's height";
      const double x = metres_of(at[0]) - region.x_m, y = metres_of(at[1]) - region.y_m;
      const double c = std::cos(region.heading_rad), s = std::sin(region.heading_rad);
      const bool is_on = std::abs(c * x + s * y) <= 0.5 * region.size_x_m + 1e-8 &&
                         std::abs(c * y - s * x) <= 0.5 * region.size_y_m + 1e-8;
      if (each.kind == ConstraintKind::RegionArea && !is_on) return "not on the region";
    }
    std::uint32_t start = 0;
    while (start < network.places().size() && network.places()[start].object != each.object) ++start;
    const ObjectPose& pose = cell.objects[each.object].start;
    const Point3 first = witness.spots[place_of(start).spot];
    if (each.kind == ConstraintKind::StartPosition && !(near(first[0], pose.x_m) && near(first[1], pose.y_m)))
      return "not where it starts";
    if (each.kind == ConstraintKind::StartHeight && !near(first[2], pose.z_m))
      return "not as high as it starts";
    if (each.kind == ConstraintKind::StartAngle &&
        !turned(witness.angles[place_of(start).angle], pose.angle_rad))
      return "not at its first angle";
    if (each.kind == ConstraintKind::FinalAngle && !turned(witness.angles[place_of(handling.place).angle],
                                                           *network.actions()[each.action].final_angle_rad))
      return "not at its final angle";
    if (each.kind == ConstraintKind::Beyond) {
      const Beyond& beyond = network.actions()[each.action].beyond[each.which];
      std::uint32_t other = Network::kNone;
      for (std::uint32_t p = 0; p < network.places().size(); ++p) {
        const bool before = p < handling.place || other == Network::kNone;
        if (network.places()[p].object == beyond.object && before) other = p;
      }
      const Point3 from = witness.spots[place_of(other).spot];
      const double along = std::cos(beyond.direction_rad) * metres_of(at[0] - from[0]) +
                           std::sin(beyond.direction_rad) * metres_of(at[1] - from[1]);
      if (along < beyond.distance_m - 1e-8) return "not beyond the other one";
    }
  }
  return "";
}

}  // namespace stepwright::tamp::testing

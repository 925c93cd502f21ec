#include "tests/bench/reach/paper_search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>

#include "supervisor/geometry/radical_inverse.h"
#include "tests/bench/reach/filter_domain.h"

namespace stepwright::bench {
namespace {

using tamp::Action;
using tamp::ActionKind;
using tamp::Angle;
using tamp::Check;
using tamp::Configuration;
using tamp::Point3;
using tamp::SearchOutcome;

// Places of a list of positions times angles, in the order in which they are tried.
std::vector<std::pair<Point3, Angle>> ordered(const std::vector<Point3>& positions,
                                              const std::vector<Angle>& angles, Order order) {
  std::vector<std::pair<Point3, Angle>> all;
  for (const Point3& at : positions)
    for (const Angle angle : angles) all.emplace_back(at, angle);
  if (order == Order::Row) return all;
  std::vector<std::size_t> place(all.size());
  std::iota(place.begin(), place.end(), std::size_t{0});
  std::mt19937_64 random(17);
  std::vector<double> key(all.size());
  Point3 middle{};
  for (const Point3& at : positions)
    for (std::size_t axis = 0; axis < 3; ++axis)
      middle[axis] += at[axis] / static_cast<std::int64_t>(positions.size());
  if (order == Order::Random) std::ranges::shuffle(place, random);
  if (order == Order::CentreOut) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Angle turned = std::min(all[k].second, Angle{0} - all[k].second);
      key[k] = std::hypot(tamp::metres_of(all[k].first[0] - middle[0]),
                          tamp::metres_of(all[k].first[1] - middle[1])) +
               1e-12 * static_cast<double>(turned);
    }
    std::ranges::stable_sort(place, {}, [&](std::size_t k) { return key[k]; });
  }
  if (order == Order::Halton) {
    // Points of a sequence in base 2 and 3, each followed to the place where it falls, without repetition.
    std::vector<bool> taken(all.size(), false);
    place.clear();
    for (std::size_t k = 1; place.size() < all.size() && k < 200 * all.size(); ++k) {
      const auto position =
          static_cast<std::size_t>(geometry::radical_inverse(k, 2) * static_cast<double>(positions.size()));
      const auto angle =
          static_cast<std::size_t>(geometry::radical_inverse(k, 3) * static_cast<double>(angles.size()));
      const std::size_t at = position * angles.size() + angle;
      if (taken[at]) continue;
      taken[at] = true;
      place.push_back(at);
    }
    for (std::size_t k = 0; k < all.size(); ++k)
      if (!taken[k]) place.push_back(k);
  }
  std::vector<std::pair<Point3, Angle>> result;
  for (const std::size_t k : place) result.push_back(all[k]);
  return result;
}

class PaperSearch {
 public:
  PaperSearch(const tamp::WorkCell& cell, std::span<const Action> sequence, const tamp::Discretisation& how,
              const tamp::Checker& check, Order order, const PaperLimits& limits)
      : cell_(cell),
        sequence_(sequence),
        how_(how),
        check_(check),
        order_(order),
        limits_(limits),
        until_(std::chrono::steady_clock::now() +
               std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                   std::chrono::duration<double>(limits.most_s))) {
    for (const tamp::Object& object : cell.objects)
      poses_.push_back({{tamp::nanometres_of(object.start.x_m), tamp::nanometres_of(object.start.y_m),
                         tamp::nanometres_of(object.start.z_m)},
                        tamp::angle_of(object.start.angle_rad)});
    hands_.resize(cell.arms.size());
    grasps_.resize(cell.arms.size());
  }

  PaperAnswer run(FilterDomain* filter) {
    filter_ = filter;
    Domain domain;
    if (filter_ != nullptr) {
      const auto filtered = filter_->filter(filter_->initial());
      if (!filtered) {
        answer_.outcome = SearchOutcome::Infeasible;
        answer_.refuted = true;
        return answer_;
      }
      domain = *filtered;
    }
    const bool solved = descend(0, domain);
    answer_.outcome = solved     ? SearchOutcome::Solved
                      : stopped_ ? SearchOutcome::Exhausted
                                 : SearchOutcome::Infeasible;
    return answer_;
  }

 private:
  struct Pose {
    Point3 at{};
    Angle angle = 0;
  };

  bool descend(std::size_t k, const Domain& domain) {
    while (k < sequence_.size() && sequence_[k].kind == ActionKind::MoveAway) ++k;
    if (k == sequence_.size()) return true;
    const Action& action = sequence_[k];
    const bool picks = action.kind == ActionKind::Pick;
    const Pose pose = poses_[action.object];
    const std::vector<Point3> positions =
        picks ? std::vector{pose.at} : squares_of(cell_.regions[*action.region], how_.square(*action.region));
    const std::vector<Angle> angles = !picks && action.final_angle_rad
                                          ? std::vector{tamp::angle_of(*action.final_angle_rad)}
                                          : angles_of(how_);
    if (picks) grasps_[action.arm] = action.grasp;
    const std::int64_t rise = tamp::nanometres_of(cell_.grasps[grasps_[action.arm]].height_m);
    for (const auto& [at, angle] : ordered(positions, angles, order_)) {
      if (stop()) return false;
      const Angle object = picks ? pose.angle : angle, hand = picks ? angle : hands_[action.arm];
      Configuration to{k, action.arm, action.object, at, object, at, object + hand};
      to.tool[2] += rise;
      Domain next;
      if (filter_ != nullptr) {
        const auto assigned = filter_->assign(domain, to);
        if (!assigned) continue;
        const auto filtered = filter_->filter(*assigned);
        if (!filtered) continue;
        next = *filtered;
      }
      chain_.push_back(to);
      ++answer_.configurations;
      if (check_(chain_) == Check::Passed) {
        const Angle hand_before = hands_[action.arm];
        const std::size_t grasp_before = grasps_[action.arm];
        poses_[action.object] = {at, object};
        hands_[action.arm] = hand;
        if (descend(k + 1, next)) return true;
        poses_[action.object] = pose;
        hands_[action.arm] = hand_before;
        grasps_[action.arm] = grasp_before;
      }
      chain_.pop_back();
    }
    return false;
  }

  bool stop() {
    stopped_ = stopped_ || answer_.configurations >= limits_.most_configurations ||
               std::chrono::steady_clock::now() > until_;
    return stopped_;
  }

  const tamp::WorkCell& cell_;
  std::span<const Action> sequence_;
  const tamp::Discretisation& how_;
  const tamp::Checker& check_;
  Order order_;
  PaperLimits limits_;
  std::chrono::steady_clock::time_point until_;
  FilterDomain* filter_ = nullptr;
  std::vector<Pose> poses_;
  std::vector<Angle> hands_;
  std::vector<std::size_t> grasps_;
  std::vector<Configuration> chain_;
  PaperAnswer answer_;
  bool stopped_ = false;
};

}  // namespace

const char* name_of(Order order) {
  switch (order) {
    case Order::Row:
      return "row";
    case Order::Halton:
      return "halton";
    case Order::CentreOut:
      return "centre-out";
    case Order::Random:
      return "random";
  }
  return "";
}

PaperAnswer search_and_filter(const tamp::WorkCell& cell, std::span<const Action> sequence,
                              const tamp::Discretisation& how, const tamp::Checker& check, Order order,
                              double epsilon, const PaperLimits& limits) {
  PaperAnswer all;
  all.outcome = SearchOutcome::Infeasible;
  all.refuted = true;
  // The turn that needs least turning first.
  for (const int turns : {0, 1, -1, 2, -2}) {
    FilterDomain filter(cell, sequence, turns, epsilon);
    const PaperAnswer one = PaperSearch(cell, sequence, how, check, order, limits).run(&filter);
    all.configurations += one.configurations;
    all.programs += filter.programs();
    all.refuted = all.refuted && one.refuted;
    if (one.outcome == SearchOutcome::Exhausted) all.outcome = SearchOutcome::Exhausted;
    if (one.outcome != SearchOutcome::Solved) continue;
    all.outcome = SearchOutcome::Solved;
    break;
  }
  return all;
}

PaperAnswer depth_first(const tamp::WorkCell& cell, std::span<const Action> sequence,
                        const tamp::Discretisation& how, const tamp::Checker& check, Order order,
                        const PaperLimits& limits) {
  return PaperSearch(cell, sequence, how, check, order, limits).run(nullptr);
}

}  // namespace stepwright::bench

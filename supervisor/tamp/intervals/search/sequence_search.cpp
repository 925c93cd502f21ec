#include "supervisor/tamp/intervals/search/sequence_search.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <utility>

#include "supervisor/tamp/intervals/network/network.h"

namespace stepwright::tamp {
namespace {

// Chains all of whose angles are that far from the ends of the reach are looked for first.
constexpr std::array<double, 6> kMargins_rad{0.35, 0.2, 0.1, 0.05, 0.01, 0.0};
// Looking for roomy chains ends after so many nodes.
constexpr std::size_t kRoomyNodes = 400;

struct Candidate {
  std::uint32_t slack = 0;
  Point3 at{};
  Angle angle = 0;  // of the object, of a place; of the hand, of a pick
};

class SequenceSearch {
 public:
  SequenceSearch(const WorkCell& cell, std::span<const Action> sequence, const Discretisation& how,
                 const Checker& check, const SearchLimits& limits)
      : cell_(cell),
        sequence_(sequence),
        how_(how),
        check_(check),
        limits_(limits),
        network_(cell, {}),
        angles_(angles_of(how)) {}

  SearchAnswer run() {
    for (const Action& action : sequence_) {
      if (network_.push(action)) continue;
      answer_.outcome = SearchOutcome::Infeasible;
      answer_.refuted = true;
      return answer_;
    }
    std::size_t margin = 0;
    while (margin < kMargins_rad.size()) {
      least_ = margin + 1 == kMargins_rad.size() ? 0 : angle_of(kMargins_rad[margin]);
      nodes_left_ =
          least_ == 0 ? limits_.most_nodes - std::min(answer_.nodes, limits_.most_nodes) : kRoomyNodes;
      chain_.clear();
      if (!descend(0)) {
        ++margin;
        continue;
      }
      // What has been refused stays so: the next chain is another one.
      if (passes()) return answer_;
      if (answer_.configurations >= limits_.most_configurations) return answer_;
    }
    answer_.outcome = nodes_left_ > 0 ? SearchOutcome::Infeasible : SearchOutcome::Exhausted;
    return answer_;
  }

 private:
  // Asks for each configuration of the chain that nobody has asked for.
  bool passes() {
    for (std::size_t k = 0; k < chain_.size(); ++k) {
      const std::span<const Configuration> chain{chain_.data(), k + 1};
      const Configuration* before = k == 0 ? nullptr : &chain_[k - 1];
      if (known_from(before, chain_[k])) continue;
      ++answer_.configurations;
      switch (check_(chain)) {
        case Check::Passed:
          passed_.emplace_back(before ? *before : Configuration{}, chain_[k]);
          continue;
        case Check::Never:
          never_.push_back(chain_[k]);
          return false;
        case Check::NotFrom:
          not_from_.emplace_back(before ? *before : Configuration{}, chain_[k]);
          return false;
      }
    }
    answer_.outcome = SearchOutcome::Solved;
    answer_.chain = chain_;
    return true;
  }

  bool known_from(const Configuration* before, const Configuration& to) const {
    const std::pair<Configuration, Configuration> step{before ? *before : Configuration{}, to};
    return std::ranges::find(passed_, step) != passed_.end();
  }

  bool refused(const Configuration& to) const {
    if (std::ranges::find(never_, to) != never_.end()) return true;
    const std::pair<Configuration, Configuration> step{chain_.empty() ? Configuration{} : chain_.back(), to};
    return std::ranges::find(not_from_, step) != not_from_.end();
  }

  bool descend(std::size_t k) {
    while (k < sequence_.size() && sequence_[k].kind == ActionKind::MoveAway) ++k;
    if (k == sequence_.size()) return true;
    std::vector<Candidate> candidates = sequence_[k].kind == ActionKind::Pick ? hands(k) : placings(k);
    std::ranges::stable_sort(candidates, std::ranges::greater{}, &Candidate::slack);
    for (const Candidate& each : candidates) {
      if (each.slack < least_) return false;
      if (nodes_left_ == 0) return false;
      const Configuration to = configuration(k, each);
      if (refused(to)) continue;
      --nodes_left_;
      ++answer_.nodes;
      const std::size_t mark = network_.mark();
      choose(k, each);
      if (network_.propagate()) {
        chain_.push_back(to);
        if (descend(k + 1)) {
          network_.undo(mark);
          return true;
        }
        chain_.pop_back();
      }
      network_.undo(mark);
    }
    return false;
  }

  const Network::Place& place(std::size_t k) const {
    return network_.places()[network_.handlings()[k].place];
  }
  AngleId hand(std::size_t k) const { return network_.handlings()[k].hand; }

  // The action that handles the object next.
  std::optional<std::size_t> next_of(std::size_t k) const {
    for (std::size_t next = k + 1; next < sequence_.size(); ++next)
      if (sequence_[next].kind != ActionKind::MoveAway && sequence_[next].object == sequence_[k].object)
        return next;
    return std::nullopt;
  }

  std::int64_t rise(std::size_t k) const {
    std::size_t grasp = sequence_[k].grasp;
    if (sequence_[k].kind == ActionKind::Place)
      for (std::size_t before = k; before-- > 0;)
        if (sequence_[before].kind == ActionKind::Pick && sequence_[before].object == sequence_[k].object) {
          grasp = sequence_[before].grasp;
          break;
        }
    return nanometres_of(cell_.grasps[grasp].height_m);
  }

  Point3 position(std::size_t k) const {
    const Box box = network_.box(place(k).spot);
    return {box[0].middle_nm(), box[1].middle_nm(), box[2].middle_nm() + place(k).rise_nm};
  }

  // The bounds of the tool's cell, and what they and those of the cells around it have in common. The reach
  // itself is somewhere between the two.
  struct Reached {
    ArcSet here, around;

    std::uint32_t margin(Angle angle) const { return here.margin(angle) / 2 + around.margin(angle) / 2; }
    // Of the widest range of angles that are left of `angles` with this hand or at this angle.
    std::uint32_t room(const ArcSet& angles, Angle with) const {
      const auto widest = [&](const ArcSet& reached) {
        const ArcSet left = difference_of(reached.arcs(), ArcSet::point(with).arcs());
        return intersection_of(angles.arcs(), left.arcs()).widest() / 4;
      };
      return widest(here) + widest(around);
    }
  };

  Reached reach_at(std::size_t k, Point3 at) const {
    at[2] += rise(k);
    const ReachBounds& reach = *cell_.arms[sequence_[k].arm].reach;
    Reached reached;
    reached.here.add(reach.arcs_at(at));
    reached.around = reached.here;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::int64_t step : {-reach.grid().step_nm[axis], reach.grid().step_nm[axis]}) {
        Point3 beside = at;
        beside[axis] += step;
        reached.around = intersection_of(reached.around.arcs(), reach.arcs_at(beside));
      }
    }
    return reached;
  }

  // Hands for a pick: by the room here, and where the object is placed next.
  std::vector<Candidate> hands(std::size_t k) const {
    const Point3 at = position(k);
    const Angle turned = network_.angle(place(k).angle).arcs()[0].low;
    const Reached here = reach_at(k, at);
    std::vector<Candidate> found;
    const auto next = next_of(k);
    const ArcSet there = next ? reach_over(*next) : ArcSet::full();
    for (const Angle angle : angles_) {
      if (!network_.angle(hand(k)).contains(angle)) continue;
      std::uint32_t slack = here.margin(turned + angle);
      if (next) slack = std::min(slack, room_at(*next, there, angle));
      found.push_back({slack, at, angle});
    }
    return found;
  }

  ArcSet reach_over(std::size_t k) const {
    Box box = network_.box(place(k).spot);
    const std::int64_t up = rise(k) + place(k).rise_nm;
    box[2] = {box[2].low_nm + up, box[2].high_nm + up};
    return cell_.arms[sequence_[k].arm].reach->arcs_over(box);
  }

  std::uint32_t room_at(std::size_t k, const ArcSet& reached, Angle hand_angle) const {
    const ArcSet& angles = network_.angle(place(k).angle);
    if (angles.units() == 1) return reached.margin(angles.arcs()[0].low + hand_angle);
    const ArcSet left = intersection_of(
        angles.arcs(), difference_of(reached.arcs(), ArcSet::point(hand_angle).arcs()).arcs());
    return left.widest() / 2;
  }

  // Positions and angles for a place: by the room here, and of the hand that picks it up next.
  std::vector<Candidate> placings(std::size_t k) const {
    const Action& action = sequence_[k];
    const auto next = next_of(k);
    const Angle held = network_.angle(hand(k)).arcs()[0].low;
    const ArcSet& angles = network_.angle(place(k).angle);
    std::vector<Candidate> found;
    for (const Point3& at : positions(k)) {
      const Reached here = reach_at(k, at);
      if (here.here.empty()) continue;
      const Reached there = next ? reach_at(*next, at) : Reached{};
      const auto offer = [&](Angle angle) {
        if (!angles.contains(angle)) return;
        std::uint32_t slack = here.margin(angle + held);
        if (next) slack = std::min(slack, there.room(network_.angle(hand(*next)), angle));
        found.push_back({slack, at, angle});
      };
      if (action.final_angle_rad)
        offer(angle_of(*action.final_angle_rad));
      else
        for (const Angle angle : angles_) offer(angle);
    }
    return found;
  }

  std::vector<Point3> positions(std::size_t k) const {
    const Action& action = sequence_[k];
    if (!action.region) return {position(k)};
    const Box box = network_.box(place(k).spot);
    std::vector<Point3> within;
    for (const Point3& at : squares_of(cell_.regions[*action.region], how_.square(*action.region)))
      if (box[0].contains(at[0]) && box[1].contains(at[1]) && box[2].contains(at[2])) within.push_back(at);
    return within;
  }

  Configuration configuration(std::size_t k, const Candidate& each) const {
    const bool picks = sequence_[k].kind == ActionKind::Pick;
    const Angle object = picks ? network_.angle(place(k).angle).arcs()[0].low : each.angle;
    const Angle held = picks ? each.angle : network_.angle(hand(k)).arcs()[0].low;
    Configuration to{k, sequence_[k].arm, sequence_[k].object, each.at, object, each.at, object + held};
    to.tool[2] += rise(k);
    return to;
  }

  void choose(std::size_t k, const Candidate& each) {
    if (sequence_[k].kind == ActionKind::Pick)
      return network_.choose_angle(hand(k), ArcSet::point(each.angle));
    network_.choose_angle(place(k).angle, ArcSet::point(each.angle));
    const LengthId first = 3 * place(k).spot;
    for (LengthId axis = 0; axis < 3; ++axis) {
      const std::int64_t nm = each.at[axis] - (axis == 2 ? place(k).rise_nm : 0);
      network_.choose(first + axis, {nm, nm});
    }
  }

  const WorkCell& cell_;
  std::span<const Action> sequence_;
  const Discretisation& how_;
  const Checker& check_;
  const SearchLimits& limits_;
  Network network_;
  std::vector<Angle> angles_;
  SearchAnswer answer_;
  std::vector<Configuration> chain_;
  std::vector<Configuration> never_;
  std::vector<std::pair<Configuration, Configuration>> passed_, not_from_;
  std::uint32_t least_ = 0;
  std::size_t nodes_left_ = 0;
};

}  // namespace

SearchAnswer search_sequence(const WorkCell& cell, std::span<const Action> sequence,
                             const Discretisation& how, const Checker& check, const SearchLimits& limits) {
  return SequenceSearch(cell, sequence, how, check, limits).run();
}

}  // namespace stepwright::tamp

#include "supervisor/tamp/intervals/cause/witness.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stepwright::tamp {
namespace {

// A span of a spot that lies in several rows of cells, and where the upper half begins.
struct Cut {
  LengthId length = 0;
  std::int64_t upper_nm = 0;
  std::int64_t rows = 0;
};

class WitnessSearch {
 public:
  WitnessSearch(Network& network, std::size_t most_nodes) : network_(network), most_nodes_(most_nodes) {}

  Solution run() {
    if (network_.refuted()) return {Answer::Infeasible, std::nullopt, 0};
    const std::size_t mark = network_.mark();
    const Answer answer = descend();
    network_.undo(mark);
    return {answer, std::move(witness_), nodes_};
  }

 private:
  Answer descend() {
    if (++nodes_ > most_nodes_) return Answer::Unknown;
    if (const auto cut = widest_cut()) return halve(*cut);
    if (const auto angle = open_angle()) return fix(*angle);
    return take();
  }

  // The span with the most rows of cells.
  std::optional<Cut> widest_cut() const {
    std::optional<Cut> widest;
    for (const Network::Visit& visit : network_.visits()) {
      const std::uint32_t spot = network_.places()[visit.place].spot;
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const ReachGrid& grid = visit.reach->grid();
        const Span span = network_.length(3 * spot + axis);
        const std::int64_t rise = axis == 2 ? visit.rise_nm : 0;
        const std::int64_t first = grid.row(axis, span.low_nm + rise),
                           last = grid.row(axis, span.high_nm + rise);
        if (last == first || (widest && widest->rows > last - first)) continue;
        const std::int64_t middle = first + (last - first + 1) / 2;
        widest = Cut{3 * spot + axis, grid.span(axis, middle).low_nm - rise, last - first};
      }
    }
    return widest;
  }

  // How much is left: the room of all hands and objects, as logarithms.
  double room() const {
    double sum = 0.0;
    for (AngleId k = 0; k < network_.angles(); ++k)
      sum += std::log2(1.0 + static_cast<double>(network_.angle(k).widest()));
    return sum;
  }

  Answer halve(const Cut& cut) {
    const Span whole = network_.length(cut.length);
    std::pair<double, Span> halves[2] = {{0.0, {whole.low_nm, cut.upper_nm - 1}},
                                         {0.0, {cut.upper_nm, whole.high_nm}}};
    const std::size_t mark = network_.mark();
    for (auto& [left, half] : halves) {
      network_.choose(cut.length, half);
      left = network_.propagate() ? room() : -1.0;
      network_.undo(mark);
    }
    if (halves[1].first > halves[0].first) std::swap(halves[0], halves[1]);
    bool unknown = false;
    for (const auto& [left, half] : halves) {
      if (left < 0.0) continue;
      network_.choose(cut.length, half);
      network_.propagate();
      const Answer answer = descend();
      network_.undo(mark);
      if (answer == Answer::Feasible) return answer;
      unknown = unknown || answer == Answer::Unknown;
    }
    return unknown ? Answer::Unknown : Answer::Infeasible;
  }

  // The one with the least room.
  std::optional<AngleId> open_angle() const {
    std::optional<AngleId> best;
    for (AngleId k = 0; k < network_.angles(); ++k) {
      const ArcSet& set = network_.angle(k);
      if (set.units() > 1 && (!best || set.units() < network_.angle(*best).units())) best = k;
    }
    return best;
  }

  static Arc widest_of(const ArcSet& set) { return *std::ranges::max_element(set.arcs(), {}, &Arc::width); }

  Answer fix(AngleId angle) {
    const ArcSet set = network_.angle(angle);
    const Arc widest = widest_of(set);
    const std::size_t mark = network_.mark();
    network_.choose_angle(angle, ArcSet::point(widest.low + widest.width / 2));
    Answer answer = network_.propagate() ? descend() : Answer::Infeasible;
    network_.undo(mark);
    if (answer == Answer::Feasible) return answer;
    // The middle will not do: the parts beside it, halved on and on.
    bool unknown = answer == Answer::Unknown;
    ArcSet rest;
    for (const Arc arc : set.arcs())
      if (arc != widest) rest.add(arc);
    std::vector<ArcSet> parts;
    if (widest.width > 0) {
      const std::uint32_t half = widest.width / 2;
      parts.push_back(ArcSet::of({widest.low, half}));
      parts.push_back(ArcSet::of({widest.low + half + 1, widest.width - half - 1}));
    }
    if (!rest.empty()) parts.push_back(rest);
    for (const ArcSet& part : parts) {
      network_.choose_angle(angle, part);
      answer = network_.propagate() ? descend() : Answer::Infeasible;
      network_.undo(mark);
      if (answer == Answer::Feasible) return answer;
      unknown = unknown || answer == Answer::Unknown;
    }
    return unknown ? Answer::Unknown : Answer::Infeasible;
  }

  Answer take() {
    const auto point = network_.point();
    if (!point) return Answer::Unknown;  // rows that no solver's word settles
    Witness witness;
    for (std::uint32_t spot = 0; spot < network_.spots(); ++spot) {
      const Box box = network_.box(spot);
      Point3& at = witness.spots.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] = std::clamp(static_cast<std::int64_t>(std::llround((*point)[3 * spot + axis])),
                              box[axis].low_nm, box[axis].high_nm);
    }
    for (AngleId k = 0; k < network_.angles(); ++k)
      witness.angles.push_back(widest_of(network_.angle(k)).low);
    witness_ = std::move(witness);
    return Answer::Feasible;
  }

  Network& network_;
  std::size_t most_nodes_;
  std::size_t nodes_ = 0;
  std::optional<Witness> witness_;
};

}  // namespace

Solution solve(Network& network, std::size_t most_nodes) {
  return WitnessSearch(network, most_nodes).run();
}

Solution solve(const WorkCell& cell, std::span<const Action> sequence, const NetworkOptions& options,
               std::size_t most_nodes) {
  Network network(cell, options);
  for (const Action& action : sequence)
    if (!network.push(action)) return {Answer::Infeasible, std::nullopt, 0};
  return solve(network, most_nodes);
}

}  // namespace stepwright::tamp

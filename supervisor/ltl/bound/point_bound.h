#pragma once

// A lower bound of the way of a point that does a task on a floor: no plan of any vehicle is shorter.
//
// A way that does a task enters places one after the other, and each entrance moves the automaton on. The
// sides of places are cut into pieces; the bound is the shortest row of pieces from the start to acceptance,
// where from one piece to the next it is as far as between their middles (the shortest way around obstacles,
// and around places that would break the task there) less half of both. Any real way has such a row and is
// no shorter than its legs; each leg is too short by a piece's length at most. So the bound is below the
// shortest way, and above it less a piece for each place that is entered. (Plaku 2012, section 4, compares
// with the shortest way itself.)
//
// Immutable; any thread may read; nothing that it was made from is kept. Example:
//   const auto bound = PointBound::make(floor, *map, task->automaton);
//   if (bound) std::printf("%.1f m\n", bound->length_m(start, state));   // state has read the label there

#include <chrono>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "supervisor/ltl/automaton/automaton.h"
#include "supervisor/ltl/bound/sight.h"
#include "supervisor/ltl/scene/scene.h"

namespace stepwright::ltl {

struct BoundOptions {
  double piece_m = 0.25;
  std::size_t most_points = 1'500;      // corners and pieces
  std::size_t most_states = 2'000'000;  // of automaton times pieces
  std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
};

class PointBound {
 public:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  // Nothing where a bound was met. Bit k of a letter and of a label are the same place.
  static std::optional<PointBound> make(const Floor& floor, const RegionMap& map, const Automaton& automaton,
                                        const BoundOptions& options = {});

  // kNever where no way does the task.
  double length_m(geometry::Point from, std::uint32_t state) const;

 private:
  struct Piece {
    geometry::Point middle;
    double half_m = 0.0;
  };
  // A label that the floor has, and the pieces where it is entered.
  struct Atom {
    Label label = 0;
    std::uint32_t first = 0, end = 0;
  };
  // Distances where some places are closed.
  struct Field {
    std::vector<double> to_corner_m;  // of each piece and corner
    std::vector<double> legs_m;       // of each two pieces: less half of both
  };
  struct Seen {
    std::uint32_t to = 0;
    double length_m = 0.0;
    Label through = 0;
  };

  PointBound(const Floor& floor, const Automaton& automaton) : sight_(floor), automaton_(automaton) {}
  void cut(const RegionMap& map, double piece_m);
  bool look(std::chrono::steady_clock::time_point until);
  void close();
  Field field_of(Label closed) const;
  void find_ways();
  std::uint32_t next(std::uint32_t state, Label letter) const;

  Sight sight_;
  Automaton automaton_;
  std::vector<Piece> pieces_;
  std::vector<Atom> atoms_;
  std::vector<std::vector<Seen>> corners_seen_;  // from each corner: corners
  std::vector<std::vector<Seen>> seen_;          // from each piece: corners
  std::vector<std::vector<Seen>> pieces_seen_;   // and pieces
  std::vector<Label> closed_;                    // in each state of the automaton
  std::map<Label, Field> fields_;
  std::vector<double> to_go_m_;  // of each state and piece
};

// Of the problem's point and of what is left of its task behind the letters that were read; nothing where a
// bound was met, or where the task has no automaton.
std::optional<double> point_bound_m(const Problem& problem, const BoundOptions& options = {});

}  // namespace stepwright::ltl

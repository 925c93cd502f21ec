#pragma once

// Straight ways of a point between points of a floor that matter: beside corners of walls, at two distances;
// within propositions, where they are entered; beside corners of propositions, for tasks that must not enter
// them. Each way keeps a clearance from walls, costs more where that is small, and knows the labels that it
// reads (Plaku 2012, section 3.2, has triangles in this place; the ways of this graph are as long as they are
// driven).
//
// A floor of very many corners, such as that of a map, gives only each n-th of them, so that there are at
// most `most_corners`, and as few points of places: ways are between any two points.
//
// Immutable; any thread may read. Places and walls must outlive it. Example:
//   const RouteGraph graph(floor, places, walls, {.margin_m = 0.5});

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "supervisor/ltl/route/stop.h"
#include "supervisor/ltl/scene/places.h"
#include "supervisor/ltl/train/walls.h"

namespace stepwright::ltl {

struct RouteOptions {
  double margin_m = 0.4;  // no way comes nearer to a wall
  double wanted_m = 1.5;  // ways that come nearer than this cost more
  double weight = 2.0;    // cost of a metre at the walls, beyond its length
  double depth_m = 0.25;  // of points within propositions from their outline
  double spread_m = 2.0;  // between such points
  std::size_t most_corners = 1500;
  std::size_t most_inner = 1500;  // points within and beside propositions
  std::size_t threads = 1;        // that look for ways, 1 or 2; they find the same ones
  // The graph is left as it is by then, without the ways that were not looked at.
  Stop stop{};
};

class RouteGraph {
 public:
  struct Way {
    std::uint32_t to = 0;
    double cost_m = 0.0;
    double length_m = 0.0;
    std::uint32_t word = 0;  // the labels that it reads
    Label near = 0;          // places that it passes closely
  };

  RouteGraph(const Floor& floor, const Places& places, const Walls& walls, const RouteOptions& options);

  std::span<const geometry::Point> points() const { return points_; }
  std::span<const Way> ways(std::uint32_t from) const {
    return {ways_.data() + first_[from], ways_.data() + first_[from + 1]};
  }
  Label label(std::uint32_t point) const { return labels_[point]; }
  // Words by their numbers; 0 is the empty one.
  const std::vector<Label>& word(std::uint32_t number) const { return words_.all[number]; }
  std::size_t words() const { return words_.all.size(); }
  const Places& places() const { return places_; }
  double clearance_m(geometry::Point at) const { return walls_.clearance_m(at); }
  const RouteOptions& options() const { return options_; }

  // Different words, each once. Those of `before` come first in the numbering.
  struct Words {
    const Words* before = nullptr;
    std::vector<std::vector<Label>> all = {{}};
    std::map<std::vector<Label>, std::uint32_t> numbers = {{{}, 0}};

    std::uint32_t number(const std::vector<Label>& word);
    const std::vector<Label>& word(std::uint32_t number) const {
      const std::size_t first = before == nullptr ? 0 : before->all.size();
      return number < first ? before->all[number] : all[number - first];
    }
  };
  // The way between any two points, whose word is among `words`; nothing where it comes too near to a wall,
  // or reads very many labels: then there are points on it.
  std::optional<Way> way(geometry::Point from, geometry::Point to, Words& words) const;
  const Words& all_words() const { return words_; }

 private:
  void add(geometry::Point at, double margin_m);
  void add_corners(const std::vector<geometry::Point>& ring, bool hole);
  void thin_out(std::size_t from, std::size_t most);
  void add_side(std::span<const geometry::Point> ring, geometry::Point from, geometry::Point to);
  void add_places();
  // The ways from a point to those behind it, and those back.
  struct Pair {
    Way there, back;
  };
  std::vector<Pair> pairs_of(std::uint32_t from, Words& words) const;
  void connect();
  bool read(Way& way, geometry::Point from, geometry::Point to, Words& words) const;

  const Places& places_;
  const Walls& walls_;
  RouteOptions options_;
  std::vector<geometry::Point> points_;
  std::vector<Label> labels_;
  std::vector<Way> ways_;
  std::vector<std::uint32_t> first_;
  Words words_;
};

}  // namespace stepwright::ltl

#pragma once

// Pictures of a plan for the page: a floor seen from above, an automaton, and what a mission draws of its own
// kind. A mission shows them when it has a plan (Mission::show). What moves is not in them: they name the
// variables of the program that tell it, which the page has live (supervisor/doc/pictures.md).
//
//   Pictures pictures;
//   pictures.floors.push_back({.id = "floor", .border = hall.ring, .progress = "arc"});
//   show(pictures);
//
// Plain values, metres and radians.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "supervisor/geometry/point.h"

namespace stepwright::run {

using PictureRing = std::vector<geometry::Point>;

struct PictureArea {
  std::string name;
  PictureRing ring;
};

// A floor with a body on it and the way that the body goes.
struct FloorPicture {
  struct Place {
    PictureArea area;
    std::string at{};      // variable: the body is in it
    bool visited = false;  // by an earlier plan for this task
  };
  // What the body covers from one arc of its way to another; outlines as of union_outlines.
  struct Swept {
    double from_m = 0.0;
    double to_m = 0.0;
    std::vector<PictureRing> outlines{};
  };
  struct WayPoint {
    geometry::Point at;
    double arc_m = 0.0;
    bool reverse = false;  // on the way to the next one
  };
  // Where the way enters places.
  struct Stop {
    std::vector<std::string> places;
    double arc_m = 0.0;
    bool counts = true;  // for the task; false: the way leads through
  };
  // A box; the first one is at the body's pose.
  struct Link {
    double length_m = 0.0;
    double width_m = 0.0;
    double behind_m = 0.0;   // its middle behind that of the link in front, along its own heading
    std::string hitch{};     // variable: heading of the link in front less its own,
    double hitch_rad = 1.0;  // in so many radians
  };

  std::string id{};
  std::string program{};  // digest of the program whose way this is; empty: nothing is planned
  PictureRing border{};
  std::vector<PictureArea> walls{};
  std::vector<PictureArea> blocked{};
  std::vector<Place> places{};
  PictureRing corners{};  // of the regions
  std::vector<std::array<std::uint32_t, 3>> regions{};
  std::vector<PictureRing> earlier{};  // what was covered by earlier plans of this run
  std::vector<Swept> swept{};
  std::vector<WayPoint> way{};
  std::vector<Stop> stops{};  // in the order of their arcs
  double length_m = 0.0;
  double covered_m = 0.0;  // when the picture was made
  std::string progress{};  // variables: the arc that the body has come to,
  std::string x{}, y{}, heading{};
  std::string coupled{};  // how many links follow the first one; empty: all
  std::vector<Link> links{};
};

// Of a task: which of its states leads to which.
struct AutomatonPicture {
  enum class Verdict : std::uint8_t { Undecided, Done, Failed };
  struct State {
    std::uint32_t state = 0;
    std::uint32_t column = 0;
    double row = 0.0;
    Verdict verdict = Verdict::Undecided;
    std::optional<std::uint32_t> left{};  // edges to the nearest state that is done
  };
  struct Edge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::vector<std::vector<std::string>> letters{};  // any of them leads there: what holds together
  };

  std::string id{};
  std::string text{};      // the task
  std::string variable{};  // the state that holds now
  std::uint32_t initial = 0;
  std::vector<std::uint32_t> planned{};  // states that the plan goes through, from where it begins
  std::vector<State> states{};
  std::vector<Edge> edges{};  // between different states
  std::size_t left_out = 0;   // so many states are more than can be drawn
};

// A picture of a mission's own kind, which its folder writes: an object with `kind` and `id`, and an empty
// list `left_out`.
struct OwnPicture {
  std::string json{};
  std::vector<std::string> dispensable{};  // keys that it is worth looking at without, the least first
};

struct Pictures {
  std::vector<FloorPicture> floors{};
  std::vector<AutomatonPicture> automata{};
  std::vector<OwnPicture> own{};
};

// JSON text of at most dds::kMaxPicturesBytes: what is too long is left out, and the picture says what that
// is.
std::string to_json(const Pictures& pictures);

}  // namespace stepwright::run

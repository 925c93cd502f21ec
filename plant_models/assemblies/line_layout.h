#pragma once

// Layout of the sorting line: the places of its parts. x runs along the main line, 0 at the end of the
// infeed; y to the left of the way the boxes go, 0 in the middle of the main line. Plain values.

#include <cstddef>
#include <string>
#include <vector>

#include "plant_models/assemblies/line_parameters.h"
#include "plant_models/body2d/body_geometry.h"

namespace stepwright::assemblies {

using body2d::Area;
using body2d::Vec2;

struct BeltPlace {
  std::string name;  // "in", "r", "d1", .., "e", "t"
  Area area;
  Vec2 direction;  // of running, length 1
};

struct EyePlace {
  std::string name;  // "in", "r", "d1", .., "e", "t", "t1"
  Vec2 from;         // the light barrier; both ends alike for one that looks down at a point
  Vec2 to;
};

struct PusherPlace {
  std::string name;       // "1", .., "e", "t"
  std::size_t belt = 0;   // in front of it
  double length_m = 0.0;  // of the paddle, along x
  Vec2 home;              // middle of the paddle
  Vec2 direction;         // of pushing
  double stroke_m = 0.0;
};

struct ChutePlace {
  Area area;
  Vec2 direction;
  Vec2 beam_from;  // of its counter
  Vec2 beam_to;
  Area exit;  // a box whose middle is here is taken away: delivered
};

struct WallPlace {
  Vec2 from;
  Vec2 to;
};

struct LineLayout {
  std::vector<BeltPlace> belts;      // infeed, reader, diverters, end, lane
  std::vector<EyePlace> eyes;        // one for each belt, in their order; then t1, the beginning of the lane
  std::vector<PusherPlace> pushers;  // one for each diverter, then e and t
  std::vector<ChutePlace> chutes;
  std::vector<WallPlace> walls;
  Vec2 arrival;  // middle of a box that arrives, without its offset
  Area bounds;   // what lies outside has fallen off the line

  std::size_t infeed() const { return 0; }
  std::size_t reader() const { return 1; }
  std::size_t end() const { return belts.size() - 2; }
  std::size_t lane() const { return belts.size() - 1; }
};

LineLayout make_layout(const LineParameters& parameters);

}  // namespace stepwright::assemblies

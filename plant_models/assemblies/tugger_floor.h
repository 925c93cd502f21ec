#pragma once

// Obstacles around a tugger train, and the distances that it keeps: walls, obstacles, blockages, and trailers
// that were left somewhere. It knows boxes and outlines only, no plan.
//
// Threads: one at a time. No heap after construction.
//
//   TuggerFloor floor(parameters);
//   if (floor.touches(train.boxes())) ...           // once in each step
//   floor.note_gap(train.boxes());

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "plant_models/assemblies/floor_polygon.h"
#include "plant_models/assemblies/tugger_parameters.h"

namespace stepwright::assemblies {

class TuggerFloor {
 public:
  explicit TuggerFloor(const TuggerParameters& parameters);

  void set_blocked(std::size_t blockage, bool blocked) { blockages_[blockage].present = blocked; }
  bool blocked(std::size_t blockage) const { return blockages_[blockage].present; }

  // Trailer `link` stands there, 1 the first one; nothing: it is coupled, or not there.
  void leave(std::size_t link, std::optional<PlacedBox> box);
  const std::optional<PlacedBox>& left(std::size_t link) const { return left_[link - 1]; }

  // Whether a box of the train meets something of the floor, or one that is not its neighbour. The trailer
  // that was uncoupled from it is its last link's neighbour until it has been free once.
  bool touches(std::span<const PlacedBox> train);
  // Whether it meets what always stands there.
  bool in_a_wall(const PlacedBox& box) const;
  // Whether it meets nothing of the floor, where of the trailers that were left those before `from_link` do
  // not count.
  bool is_free(const PlacedBox& box, std::size_t from_link) const;

  // The least distance of a box of the train to a wall, an obstacle or a blockage so far; 0 after contact.
  double smallest_gap_m() const { return smallest_gap_m_; }
  void note_gap(std::span<const PlacedBox> train);
  void note_contact() { smallest_gap_m_ = 0.0; }

  // Whether nothing blocks what the scanner in front of the tractor sees.
  bool way_is_free(const PlacedBox& tractor) const;
  bool in_place(std::size_t place, body2d::Vec2 point) const { return places_[place].contains(point); }

 private:
  struct Blockage {
    FloorOutline outline;
    bool present = false;
  };

  bool in_a_blockage(const PlacedBox& box) const;
  bool meets_left(const PlacedBox& box, std::size_t from_link) const;

  std::vector<FloorOutline> walls_;
  std::vector<FloorOutline> obstacles_;
  std::vector<Blockage> blockages_;
  std::vector<FloorOutline> places_;
  std::array<std::optional<PlacedBox>, kMostTuggerTrailers> left_;
  bool neighbour_ = false;  // the first one that was left has been behind the train ever since
  double scanner_m_;
  double smallest_gap_m_ = 1e3;  // farther than any floor is long
};

}  // namespace stepwright::assemblies

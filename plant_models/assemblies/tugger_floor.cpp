#include "plant_models/assemblies/tugger_floor.h"

#include <algorithm>

namespace stepwright::assemblies {
namespace {

std::vector<FloorOutline> outlines_of(const std::vector<FloorPolygon>& polygons) {
  std::vector<FloorOutline> outlines;
  for (const FloorPolygon& polygon : polygons) outlines.emplace_back(polygon.ring);
  return outlines;
}

}  // namespace

TuggerFloor::TuggerFloor(const TuggerParameters& parameters)
    : walls_(outlines_of(parameters.walls)),
      obstacles_(outlines_of(parameters.obstacles)),
      places_(outlines_of(parameters.places)),
      scanner_m_(parameters.scanner_m) {
  for (const FloorPolygon& blockage : parameters.blockages)
    blockages_.push_back({FloorOutline(blockage.ring), false});
}

void TuggerFloor::leave(std::size_t link, std::optional<PlacedBox> box) {
  left_[link - 1] = box;
  neighbour_ = true;
}

bool TuggerFloor::in_a_wall(const PlacedBox& box) const {
  const auto is_met = [&box](Solid solid) {
    return [&box, solid](const FloorOutline& outline) { return meets(box, outline, solid); };
  };
  return std::any_of(walls_.begin(), walls_.end(), is_met(Solid::Outside)) ||
         std::any_of(obstacles_.begin(), obstacles_.end(), is_met(Solid::Inside));
}

bool TuggerFloor::in_a_blockage(const PlacedBox& box) const {
  return std::any_of(blockages_.begin(), blockages_.end(), [&box](const Blockage& blockage) {
    return blockage.present && meets(box, blockage.outline, Solid::Inside);
  });
}

bool TuggerFloor::meets_left(const PlacedBox& box, std::size_t from_link) const {
  for (std::size_t link = from_link; link <= left_.size(); ++link) {
    if (left(link) && meets(box, *left(link))) return true;
  }
  return false;
}

bool TuggerFloor::is_free(const PlacedBox& box, std::size_t from_link) const {
  return !in_a_wall(box) && !in_a_blockage(box) && !meets_left(box, from_link);
}

bool TuggerFloor::touches(std::span<const PlacedBox> train) {
  const std::size_t uncoupled = train.size();  // the number of the first trailer that is not coupled
  neighbour_ =
      neighbour_ && uncoupled <= left_.size() && left(uncoupled) && meets(train.back(), *left(uncoupled));
  for (std::size_t i = 0; i < train.size(); ++i) {
    const bool hitched = neighbour_ && i + 1 == train.size();
    if (!is_free(train[i], hitched ? uncoupled + 1 : uncoupled)) return true;
    for (std::size_t k = i + 2; k < train.size(); ++k) {
      if (meets(train[i], train[k])) return true;
    }
  }
  return false;
}

void TuggerFloor::note_gap(std::span<const PlacedBox> train) {
  for (const PlacedBox& box : train) {
    for (const auto* outlines : {&walls_, &obstacles_}) {
      for (const FloorOutline& outline : *outlines)
        smallest_gap_m_ = distance_m(box, outline, smallest_gap_m_);
    }
    for (const Blockage& blockage : blockages_) {
      if (blockage.present) smallest_gap_m_ = distance_m(box, blockage.outline, smallest_gap_m_);
    }
  }
}

bool TuggerFloor::way_is_free(const PlacedBox& tractor) const {
  PlacedBox seen = tractor;
  seen.half_length_m = 0.5 * scanner_m_;
  seen.middle = tractor.middle + (tractor.half_length_m + seen.half_length_m) * tractor.ahead;
  return std::none_of(blockages_.begin(), blockages_.end(), [&](const Blockage& blockage) {
    return blockage.present && meets(seen, blockage.outline, Solid::Inside);
  });
}

}  // namespace stepwright::assemblies

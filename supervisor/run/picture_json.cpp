#include "supervisor/run/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "runtime/dds/plan_channel.h"
#include "supervisor/run/internal/record_json.h"

namespace stepwright::run {
namespace {

using internal::json;

// Millimetres are finer than what is drawn.
double drawn(double value_m) {
  return std::round(value_m * 1e3) / 1e3;
}

json ring_json(const PictureRing& ring) {
  json corners = json::array();
  for (const geometry::Point p : ring) corners.push_back({drawn(p.x_m), drawn(p.y_m)});
  return corners;
}

json rings_json(const std::vector<PictureRing>& rings) {
  json all = json::array();
  for (const PictureRing& ring : rings) all.push_back(ring_json(ring));
  return all;
}

json area_json(const PictureArea& area) {
  return {{"name", area.name}, {"corners_m", ring_json(area.ring)}};
}

template <typename Items, typename Writer>
json list_json(const Items& items, Writer written) {
  json all = json::array();
  for (const auto& item : items) all.push_back(written(item));
  return all;
}

json place_json(const FloorPicture::Place& place) {
  json one = area_json(place.area);
  one["at"] = place.at;
  one["visited"] = place.visited;
  return one;
}

json swept_json(const FloorPicture::Swept& swept) {
  return {{"from_m", drawn(swept.from_m)},
          {"to_m", drawn(swept.to_m)},
          {"outlines_m", rings_json(swept.outlines)}};
}

json stop_json(const FloorPicture::Stop& stop) {
  return {{"places", stop.places}, {"arc_m", drawn(stop.arc_m)}, {"counts", stop.counts}};
}

json link_json(const FloorPicture::Link& link) {
  return {{"length_m", link.length_m},
          {"width_m", link.width_m},
          {"behind_m", link.behind_m},
          {"hitch", link.hitch},
          {"hitch_rad", link.hitch_rad}};
}

json floor_json(const FloorPicture& floor) {
  json way = json::array();
  for (const FloorPicture::WayPoint& point : floor.way)
    way.push_back({drawn(point.at.x_m), drawn(point.at.y_m), drawn(point.arc_m), point.reverse ? -1 : 1});
  return {{"kind", "floor"},
          {"id", floor.id},
          {"program", floor.program},
          {"border_m", ring_json(floor.border)},
          {"walls", list_json(floor.walls, area_json)},
          {"blocked", list_json(floor.blocked, area_json)},
          {"places", list_json(floor.places, place_json)},
          {"regions", {{"corners_m", ring_json(floor.corners)}, {"triangles", floor.regions}}},
          {"earlier_m", rings_json(floor.earlier)},
          {"swept", list_json(floor.swept, swept_json)},
          {"way", std::move(way)},
          {"stops", list_json(floor.stops, stop_json)},
          {"length_m", drawn(floor.length_m)},
          {"covered_m", drawn(floor.covered_m)},
          {"progress", floor.progress},
          {"body",
           {{"x", floor.x},
            {"y", floor.y},
            {"heading", floor.heading},
            {"coupled", floor.coupled},
            {"links", list_json(floor.links, link_json)}}},
          {"left_out", json::array()}};
}

const char* word_of(AutomatonPicture::Verdict verdict) {
  switch (verdict) {
    case AutomatonPicture::Verdict::Done:
      return "done";
    case AutomatonPicture::Verdict::Failed:
      return "failed";
    case AutomatonPicture::Verdict::Undecided:
      break;
  }
  return "undecided";
}

json state_json(const AutomatonPicture::State& state) {
  return {{"state", state.state},
          {"column", state.column},
          {"row", state.row},
          {"verdict", word_of(state.verdict)},
          {"left", state.left ? json(*state.left) : json(nullptr)}};
}

json edge_json(const AutomatonPicture::Edge& edge) {
  return {{"from", edge.from}, {"to", edge.to}, {"letters", edge.letters}};
}

json automaton_json(const AutomatonPicture& automaton) {
  return {{"kind", "automaton"},
          {"id", automaton.id},
          {"text", automaton.text},
          {"variable", automaton.variable},
          {"initial", automaton.initial},
          {"planned", automaton.planned},
          {"states", list_json(automaton.states, state_json)},
          {"edges", list_json(automaton.edges, edge_json)},
          {"left_out", automaton.left_out}};
}

// What a floor is still worth looking at without, the least first.
constexpr std::array kDispensable = {"regions", "earlier_m", "swept", "walls"};

}  // namespace

std::string to_json(const Pictures& pictures) {
  json all = json::array();
  for (const FloorPicture& floor : pictures.floors) all.push_back(floor_json(floor));
  for (const AutomatonPicture& automaton : pictures.automata) all.push_back(automaton_json(automaton));
  std::vector<std::string> dispensable(kDispensable.begin(), kDispensable.end());
  for (const OwnPicture& own : pictures.own) {
    all.push_back(json::parse(own.json, nullptr, /*allow_exceptions=*/false));
    for (const std::string& part : own.dispensable)
      if (std::ranges::find(dispensable, part) == dispensable.end()) dispensable.push_back(part);
  }
  json document = {{"pictures", std::move(all)}};
  std::string text = internal::text_of(document);
  for (const std::string& part : dispensable) {
    if (text.size() <= dds::kMaxPicturesBytes) return text;
    for (json& one : document["pictures"])
      if (one.erase(part) > 0) one["left_out"].push_back(part);
    text = internal::text_of(document);
  }
  return text.size() <= dds::kMaxPicturesBytes ? text : R"({"pictures":[]})";
}

}  // namespace stepwright::run

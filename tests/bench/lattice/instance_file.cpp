#include "tests/bench/lattice/instance_file.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace stepwright::bench {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const fleet::Bounds& bounds) {
  return Json::array({bounds.least.count(), bounds.most.count()});
}

Json json_of(const fleet::TrajectoryEnvelope& envelope) {
  Json polygons = Json::array();
  for (const fleet::EnvelopePolygon& polygon : envelope.polygons) {
    Json corners = Json::array();
    for (const geometry::Point corner : polygon.area.corners()) {
      corners.push_back(Json::array({corner.x_m, corner.y_m}));
    }
    polygons.push_back({{"corners_m", corners}, {"stay_ms", json_of(polygon.stay)}});
    if (polygons.size() < envelope.polygons.size()) polygons.back()["overlap_ms"] = json_of(polygon.overlap);
  }
  return {{"name", envelope.vehicle}, {"polygons", polygons}};
}

Json start_of(const fleet::TrajectoryEnvelope& envelope) {
  return {{"name", envelope.vehicle + " starts at once"},
          {"to", {{"vehicle", envelope.vehicle}, {"polygon", 0}, {"side", "entry"}}},
          {"distance_ms", Json::array({0, 0})}};
}

}  // namespace

std::string Instance::name() const {
  char text[64];
  std::snprintf(text, sizeof text, "circle_n%02d_r%03d_v%.1f.json", vehicles, run, speed.max_mps);
  return text;
}

Instance make_instance(CircleEnvelopes& circle, int vehicles, int run, const fleet::SpeedLimits& speed) {
  Instance instance{vehicles, run, speed, support::circle_problem(vehicles, run), {}};
  for (const support::CircleTask& task : instance.tasks) {
    instance.envelopes.push_back(circle.of(task));
    instance.envelopes.back().envelope.vehicle = "v" + std::to_string(instance.envelopes.size());
    set_times(instance.envelopes.back(), speed);
  }
  return instance;
}

std::string to_json(const Instance& instance) {
  Json vehicles = Json::array();
  Json constraints = Json::array();
  for (const fleet::GrownEnvelope& grown : instance.envelopes) {
    vehicles.push_back(json_of(grown.envelope));
    constraints.push_back(start_of(grown.envelope));
  }
  return Json{{"vehicles", vehicles}, {"constraints", constraints}}.dump();
}

}  // namespace stepwright::bench

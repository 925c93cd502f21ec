#include "tests/bench/lattice/instance_file.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace stepwright::bench {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const geometry::Pose& pose) {
  return {pose.x_m, pose.y_m, pose.heading_rad};
}

Json json_of(const fleet::Bounds& bounds) {
  return {bounds.least.count(), bounds.most.count()};
}

Json json_of(const fleet::EnvelopePolygon& polygon) {
  Json corners = Json::array();
  for (const geometry::Point corner : polygon.area.corners()) {
    corners.push_back(Json::array({corner.x_m, corner.y_m}));
  }
  return {{"corners", corners}, {"stay_ms", json_of(polygon.stay)}, {"overlap_ms", json_of(polygon.overlap)}};
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
    instance.envelopes.back().envelope.vehicle = "v" + std::to_string(instance.envelopes.size() - 1);
    set_times(instance.envelopes.back(), speed);
  }
  return instance;
}

std::string to_json(const Instance& instance) {
  Json envelopes = Json::array();
  for (std::size_t k = 0; k < instance.envelopes.size(); ++k) {
    Json polygons = Json::array();
    for (const auto& polygon : instance.envelopes[k].envelope.polygons) polygons.push_back(json_of(polygon));
    envelopes.push_back({{"vehicle", instance.envelopes[k].envelope.vehicle},
                         {"start", json_of(instance.tasks[k].start.pose())},
                         {"goal", json_of(instance.tasks[k].goal.pose())},
                         {"polygons", polygons}});
  }
  const Json json = {{"problem", "circle"},
                     {"vehicles", instance.vehicles},
                     {"run", instance.run},
                     {"min_mps", instance.speed.min_mps},
                     {"max_mps", instance.speed.max_mps},
                     {"envelopes", envelopes}};
  return json.dump();
}

}  // namespace stepwright::bench

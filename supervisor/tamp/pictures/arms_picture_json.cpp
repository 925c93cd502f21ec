#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "supervisor/tamp/pictures/arms_picture.h"

namespace stepwright::tamp::pictures {
namespace {

using nlohmann::json;

double rounded(double value, double fine) {
  return std::round(value * fine) / fine;
}
// Micrometres; numbers of rotations turn a metre's end by less.
double length_of(double value_m) {
  return rounded(value_m, 1e6);
}

template <typename Items, typename Writer>
json list_json(const Items& items, Writer written) {
  json all = json::array();
  for (const auto& item : items) all.push_back(written(item));
  return all;
}

json point_json(const PicturePoint& point) {
  return {length_of(point[0]), length_of(point[1]), length_of(point[2])};
}

// x, y, z, and the rows of the rotation unless it turns nothing.
json place_json(const PicturePlace& place) {
  json numbers = point_json(place.at_m);
  if (place.rotation != PicturePlace{}.rotation)
    for (const double value : place.rotation) numbers.push_back(rounded(value, 1e9));
  return numbers;
}

json solid_json(const PictureSolid& solid) {
  json one = {{"place", place_json(solid.place)}};
  switch (solid.kind) {
    case PictureSolid::Kind::Box:
      one["kind"] = "box";
      one["size_m"] = point_json(solid.size_m);
      break;
    case PictureSolid::Kind::Cylinder:
      one["kind"] = "cylinder";
      one["radius_m"] = length_of(solid.radius_m);
      one["length_m"] = length_of(solid.length_m);
      break;
    case PictureSolid::Kind::Ball:
      one["kind"] = "ball";
      one["radius_m"] = length_of(solid.radius_m);
      break;
    case PictureSolid::Kind::Mesh:
      one["kind"] = "mesh";
      one["points_m"] = list_json(solid.points, point_json);
      one["triangles"] = solid.triangles;
      break;
  }
  return one;
}

json value_json(const PictureValue& value) {
  return {
      {"variable", value.variable}, {"factor", value.factor}, {"offset", value.offset}, {"rest", value.rest}};
}

json body_json(const ArmsPicture::Body& body) {
  return {{"name", body.name}, {"solids", list_json(body.solids, solid_json)}};
}

json surface_json(const ArmsPicture::Surface& surface) {
  return {{"name", surface.name},
          {"place", place_json(surface.place)},
          {"size_m", {length_of(surface.size_x_m), length_of(surface.size_y_m)}}};
}

const char* word_of(ArmsPicture::Motion motion) {
  switch (motion) {
    case ArmsPicture::Motion::Turns:
      return "turns";
    case ArmsPicture::Motion::Slides:
      return "slides";
    case ArmsPicture::Motion::Fixed:
      break;
  }
  return "fixed";
}

json frame_json(const ArmsPicture::Frame& frame) {
  json one = {{"name", frame.name},
              {"parent", frame.parent},
              {"arm", frame.arm},
              {"place", place_json(frame.place)},
              {"motion", word_of(frame.motion)},
              {"solids", list_json(frame.solids, solid_json)}};
  if (frame.motion != ArmsPicture::Motion::Fixed) {
    one["axis"] = {rounded(frame.axis[0], 1e9), rounded(frame.axis[1], 1e9), rounded(frame.axis[2], 1e9)};
    one["value"] = value_json(frame.value);
  }
  return one;
}

json stage_json(const ArmsPicture::Stage& stage) {
  return {
      {"arm", stage.arm}, {"from", stage.from}, {"frame", stage.frame}, {"place", place_json(stage.place)}};
}

json thing_json(const ArmsPicture::Thing& thing) {
  return {{"name", thing.name},
          {"solids", list_json(thing.solids, solid_json)},
          {"stages", list_json(thing.stages, stage_json)}};
}

json step_json(const ArmsPicture::Step& step) {
  json one = {{"kind", step.kind}, {"thing", step.thing}, {"waits", json::array()}};
  for (const ArmsPicture::Wait& each : step.waits)
    one["waits"].push_back({{"at", each.at}, {"other", each.other}, {"progress", each.progress}});
  return one;
}

json capsule_json(const ArmsPicture::Capsule& capsule) {
  return {{"frame", capsule.frame},
          {"from_m", point_json(capsule.from_m)},
          {"to_m", point_json(capsule.to_m)},
          {"radius_m", length_of(capsule.radius_m)}};
}

json held_json(const ArmsPicture::Held& held) {
  json one = capsule_json(held.body);
  one["from"] = held.from;
  one["until"] = held.until;
  return one;
}

json joint_json(const ArmsPicture::Joint& joint) {
  return {{"name", joint.name}, {"frame", joint.frame}};
}

json arm_json(const ArmsPicture::Arm& arm) {
  return {{"name", arm.name},
          {"joints", list_json(arm.joints, joint_json)},
          {"tool", arm.tool},
          {"opening", value_json(arm.opening)},
          {"capsules", list_json(arm.capsules, capsule_json)},
          {"held", list_json(arm.held, held_json)},
          {"steps", list_json(arm.steps, step_json)},
          {"progress", arm.progress},
          {"waiting", arm.waiting},
          {"grasped", arm.grasped},
          {"standing", arm.standing},
          {"error", arm.error}};
}

// x, y, z, progress.
json way_json(const ArmsPicture::Arm& arm) {
  return list_json(arm.way, [](const ArmsPicture::WayPoint& point) {
    json one = point_json(point.at_m);
    one.push_back(rounded(point.progress, 1e4));
    return one;
  });
}

json seen_json(const ArmsPicture::Seen& seen) {
  return {{"kind", seen.kind},
          {"x", value_json(seen.x)},
          {"y", value_json(seen.y)},
          {"z", value_json(seen.z)},
          {"yaw", value_json(seen.yaw)}};
}

json kind_json(const ArmsPicture::Kind& kind) {
  return {{"kind", kind.kind}, {"name", kind.name}};
}

json arms_json(const ArmsPicture& picture) {
  return {{"kind", "arms"},
          {"id", picture.id},
          {"program", picture.program},
          {"bodies", list_json(picture.bodies, body_json)},
          {"surfaces", list_json(picture.surfaces, surface_json)},
          {"frames", list_json(picture.frames, frame_json)},
          {"arms", list_json(picture.arms, arm_json)},
          {"ways", list_json(picture.arms, way_json)},
          {"things", list_json(picture.things, thing_json)},
          {"seen", list_json(picture.seen, seen_json)},
          {"kinds", list_json(picture.kinds, kind_json)},
          {"distance", picture.distance},
          {"least_distance_m", length_of(picture.least_distance_m)},
          {"cause", picture.cause},
          {"causes", picture.causes},
          {"cause_arm", picture.cause_arm},
          {"left_out", json::array()}};
}

}  // namespace

run::OwnPicture page_picture(const ArmsPicture& picture) {
  return {arms_json(picture).dump(-1, ' ', false, json::error_handler_t::replace), {"ways", "bodies"}};
}

}  // namespace stepwright::tamp::pictures

#include "supervisor/motion/collision/attached_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stepwright::motion {

AttachedBody attach(const Obstacle& object, int link, const Transform& place, std::vector<int> touching,
                    const CoverOptions& cover) {
  Body body{object.shape, object.mesh};
  body.shape.origin = place;
  return attach(object.name, link, {std::move(body)}, std::move(touching), cover);
}

AttachedBody attach(std::string name, int link, std::vector<Body> bodies, std::vector<int> touching,
                    const CoverOptions& cover) {
  std::vector<Sphere> spheres = motion::cover(Bodies{bodies}, cover).links.front().spheres;
  return {std::move(name), link, std::move(bodies), std::move(spheres), std::move(touching)};
}

AttachedBody moved(AttachedBody body, int link, const Transform& by, std::vector<int> touching) {
  body.link = link;
  body.touching = std::move(touching);
  for (Body& each : body.bodies) each.shape.origin = by * each.shape.origin;
  for (Sphere& each : body.spheres) each.centre_m = by * each.centre_m;
  body.bound.centre_m = by * body.bound.centre_m;
  return body;
}

result::Result<void> check_attached(const Robot& robot, const std::vector<AttachedBody>& attached) {
  const auto links = static_cast<int>(robot.links.size());
  for (const AttachedBody& each : attached) {
    const auto refuse = [&](const std::string& what) {
      return result::fail(code::kBadAttached, {}, "'" + each.name + "', which is carried, " + what);
    };
    const auto unknown = [&](int link) { return link < 0 || link >= links; };
    if (unknown(each.link) || std::any_of(each.touching.begin(), each.touching.end(), unknown))
      return refuse("names a link that the robot does not have");
    if (each.bodies.empty() || each.spheres.empty()) return refuse("has no body");
    World alone;
    const auto spheres = std::make_shared<const std::vector<Sphere>>(each.spheres);
    for (const Body& body : each.bodies)
      alone.obstacles.push_back({each.name, body.shape, body.mesh, body.mesh ? spheres : nullptr});
    if (const auto sound = check_world(alone); !sound) return refuse(sound.error().front().message);
    for (const Sphere& sphere : each.spheres)
      if (!std::isfinite(length(sphere.centre_m)) || !(sphere.radius_m > 0.0))
        return refuse("has a sphere without size");
  }
  return {};
}

Semantics joined_pairs(const Robot& robot) {
  Semantics semantics;
  for (int link = 1; link < static_cast<int>(robot.links.size()); ++link)
    semantics.disabled.emplace_back(robot.parent_link(link), link);
  return semantics;
}

CarryingRobot carrying(const Robot& robot, const SphereModel* spheres, const Bodies* bodies,
                       const Semantics* semantics, const std::vector<AttachedBody>& attached) {
  CarryingRobot all{robot, spheres ? *spheres : SphereModel{}, bodies ? *bodies : Bodies{}, {}};
  if (semantics)
    all.semantics.disabled = semantics->disabled;
  else
    all.semantics = joined_pairs(robot);
  for (const AttachedBody& each : attached) {
    const auto number = static_cast<int>(all.robot.links.size());
    Joint joint;
    joint.name = each.name;
    joint.parent = each.link;
    all.robot.joints.push_back(std::move(joint));
    all.robot.links.push_back({each.name, {}});
    if (spheres)
      all.spheres.links.push_back(
          {each.bound.radius_m > 0.0 ? each.bound : bound_of(each.spheres), each.spheres});
    if (bodies) all.bodies.push_back(each.bodies);
    all.semantics.disabled.emplace_back(each.link, number);
    for (const int other : each.touching) all.semantics.disabled.emplace_back(other, number);
  }
  std::sort(all.semantics.disabled.begin(), all.semantics.disabled.end());
  return all;
}

}  // namespace stepwright::motion

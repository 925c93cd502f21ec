#pragma once

// Things that a robot carries: an object that a hand has taken moves with the hand's link, and is checked as
// a link of its own.
//
//   AttachedBody can = attach(world_can, robot.link("right_hand"), hand_to_can, {finger_1, finger_2});
//   auto checker = CollisionChecker::make(robot, spheres, &semantics, world, coordinates, rest, {can});
//   auto exact =
//       ExactChecker::make(robot, bodies, &semantics, world, coordinates, rest, &spheres, {can});
//
// The obstacle that it was is to be taken out of the world. A carried thing is checked with the world, with
// all links but `touching` and the one that carries it, and with what other links carry; not with what stands
// still against it. Contacts are named after it. Values; any thread.

#include <string>
#include <vector>

#include "supervisor/motion/collision/world.h"
#include "supervisor/motion/robot/semantics.h"
#include "supervisor/motion/spheres/sphere_model.h"

namespace stepwright::motion {

struct AttachedBody {
  std::string name;
  int link = 0;                 // that carries it
  std::vector<Body> bodies;     // in the frame of that link
  std::vector<Sphere> spheres;  // that contain them, in the frame of that link
  std::vector<int> touching;    // links that it may touch besides
  Sphere bound{};               // around all spheres; radius 0: it is computed when it is needed
};

// How closely the spheres of what is carried follow it, unless it is said otherwise: closer than those of a
// robot, because hands put things down near others.
inline constexpr CoverOptions kCarriedCover{.protrusion_m = 0.005, .most_per_body = 64};

// A box, cylinder, sphere or mesh as it is in a world; `place` is that of its centre (a mesh: of its origin)
// in the frame of the link, and replaces the obstacle's own.
AttachedBody attach(const Obstacle& object, int link, const Transform& place, std::vector<int> touching = {},
                    const CoverOptions& cover = kCarriedCover);
// Several bodies as one thing, each at its origin in the frame of the link.
AttachedBody attach(std::string name, int link, std::vector<Body> bodies, std::vector<int> touching = {},
                    const CoverOptions& cover = kCarriedCover);

// The same thing in another grasp or hand, without covering it anew, which takes milliseconds: `by` moves it
// from where it is to its place in the frame of `link`.
AttachedBody moved(AttachedBody body, int link, const Transform& by, std::vector<int> touching = {});

// Fails with A0302: a link that is not there, no body, a body that check_world would refuse.
[[nodiscard]] result::Result<void> check_attached(const Robot& robot,
                                                  const std::vector<AttachedBody>& attached);

// The robot with a further link for each of them, last and in their order: what both checkers look at.
struct CarryingRobot {
  Robot robot;
  SphereModel spheres;
  Bodies bodies;        // empty if none were given
  Semantics semantics;  // only its disabled pairs
};
// Links that are joined to each other.
Semantics joined_pairs(const Robot& robot);
// Without semantics links that are joined to each other are disabled. Requires check_attached.
CarryingRobot carrying(const Robot& robot, const SphereModel* spheres, const Bodies* bodies,
                       const Semantics* semantics, const std::vector<AttachedBody>& attached);

namespace code {
inline constexpr const char* kBadAttached = "A0302";  // a carried thing without link, body or sound numbers
}

}  // namespace stepwright::motion

#pragma once

// Belts that carry a box: dry (Coulomb) friction between its bottom and the surfaces below.
//
// A belt in a plane seen from above is the floor, which is no contact of Box2D. So the box stands on a grid
// of 3 x 3 points, each of which bears a ninth of its weight. At each point friction pulls the box towards
// the velocity of the surface there, with at most grip x weight, and within a step no further than to that
// velocity:
//
//   j = -(m/9) (v_point - v_surface), |j| <= grip (m/9) g dt
//
// The sum is exact for sliding without rotation, turns a box that straddles two belts, and cannot overshoot:
// the points at a third of each side take 8/9 of a spin at rest on a surface.
//
// Pure but for the momentum that it gives to the box; no heap.

#include <span>

#include "plant_models/body2d/world.h"

namespace stepwright::body2d {

struct Surface {
  Area area;
  Vec2 velocity;      // of the belt, m/s
  double grip = 0.5;  // coefficient of friction, the same at rest and sliding
};

// Lets the surfaces pull at a box for one step of the world. The first surface that holds a point counts;
// where there is none the point slides on the ground (velocity 0, `ground_grip`). Adds what the box pulls
// each surface with, against its motion, to `pulled_n` (as many as surfaces).
void convey(World& world, BodyId box, Rectangle shape, std::span<const Surface> surfaces, double ground_grip,
            std::span<double> pulled_n);

}  // namespace stepwright::body2d

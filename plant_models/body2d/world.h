#pragma once

// Rigid rectangles, walls and driven paddles in a horizontal plane seen from above: Box2D 2.4 behind a
// move-only handle. There is no gravity in the plane; what carries bodies along is `conveying.h`.
//
// Thread rule: one thread at a time. Bodies are added at set-up; `step` and everything that moves a body
// then takes memory only when more contacts exist at once than ever before, of which `warm_up` makes enough.
// Invariants: bodies are stepped in the order in which they were added, always by the same time; the same
// calls give bit-identical poses on the same machine (Box2D computes in single precision).
//
//   World world({.step_s = 0.005});
//   const BodyId box = world.add_box({.rectangle = {{0.3, 0.25}}, .mass_kg = 2.0}, {{0.0, 0.0}, 0.1});
//   world.push(box, {0.5, 0.0}, 0.0);
//   world.step();
//   const Pose pose = world.pose(box);

#include <cstdint>
#include <memory>

#include "plant_models/body2d/body_geometry.h"
#include "runtime/base/strong_id.h"

namespace stepwright::body2d {

struct BodyTag;
using BodyId = base::StrongId<BodyTag>;  // in the order of adding

struct WorldSettings {
  double step_s = 0.005;  // of one step()
  int velocity_iterations = 8;
  int position_iterations = 3;
};

struct BoxBody {
  Rectangle rectangle;
  double mass_kg = 1.0;   // evenly spread
  double friction = 0.3;  // against other bodies, not against the ground
};

class World {
 public:
  explicit World(const WorldSettings& settings);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  // A straight wall without thickness.
  BodyId add_wall(Vec2 from, Vec2 to, double friction);
  // A rectangle that moves as told, whatever is in its way.
  BodyId add_paddle(Rectangle rectangle, const Pose& pose, double friction);
  // A free body. A fast one does not pass through walls and paddles within a step.
  BodyId add_box(const BoxBody& box, const Pose& pose);

  // A body that is not there touches nothing and keeps its pose.
  void set_present(BodyId body, bool present);
  bool present(BodyId body) const;

  Pose pose(BodyId body) const;
  Motion motion(BodyId body) const;
  // Puts a body somewhere; it does not sweep what lies between.
  void place(BodyId body, const Pose& pose, const Motion& motion);
  // How a paddle moves until the next call.
  void drive(BodyId paddle, Vec2 velocity);
  // Momentum (kg m/s) and angular momentum (kg m2/s) for a box, at once.
  void push(BodyId box, Vec2 momentum, double angular_momentum);

  double mass_kg(BodyId body) const;
  double inertia_kg_m2(BodyId body) const;
  // Sum of the normal forces that others pressed with against the body in the last step, N.
  double pressed_n(BodyId body) const;
  // The same as vectors: what the others pushed the body with, N.
  Vec2 force_n(BodyId body) const;
  // Translation and rotation of all boxes that are present, J.
  double kinetic_energy_j() const;

  void step();
  double step_s() const;
  // Takes the memory that a step with `contacts` contacts at once needs.
  void warm_up(int contacts);

  // Over pose, motion and presence of every body.
  std::uint64_t hash() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stepwright::body2d

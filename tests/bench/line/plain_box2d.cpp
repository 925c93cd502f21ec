#include "tests/bench/line/plain_box2d.h"

#include <box2d/box2d.h>

#include "plant_models/assemblies/line_layout.h"

namespace stepwright::bench {

struct PlainBox2d::State {
  b2World world{b2Vec2(0.0f, 0.0f)};
  std::vector<b2Body*> bodies;
  std::vector<bool> present;
};

namespace {

b2Vec2 single(body2d::Vec2 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

b2Body* add(b2World& world, b2BodyType type, body2d::Vec2 size, double mass_kg) {
  b2BodyDef def;
  def.type = type;
  def.bullet = type == b2_dynamicBody;
  b2Body* body = world.CreateBody(&def);
  b2PolygonShape shape;
  shape.SetAsBox(static_cast<float>(size.x / 2.0), static_cast<float>(size.y / 2.0));
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.density = static_cast<float>(mass_kg / (size.x * size.y));
  fixture.friction = 0.25f;
  body->CreateFixture(&fixture);
  return body;
}

}  // namespace

PlainBox2d::PlainBox2d(const assemblies::LineParameters& parameters) : state_(std::make_unique<State>()) {
  const assemblies::LineLayout layout = assemblies::make_layout(parameters);
  state_->world.SetAllowSleeping(false);
  for (const assemblies::WallPlace& wall : layout.walls) {
    b2BodyDef def;
    b2EdgeShape edge;
    edge.SetTwoSided(single(wall.from), single(wall.to));
    state_->world.CreateBody(&def)->CreateFixture(&edge, 0.0f);
  }
  for (const assemblies::BoxData& box : make_boxes(parameters)) {
    state_->bodies.push_back(add(state_->world, b2_dynamicBody, box.rectangle.size, box.mass_kg));
    state_->bodies.back()->SetEnabled(false);
  }
  for (const assemblies::PusherPlace& place : layout.pushers) {
    state_->bodies.push_back(
        add(state_->world, b2_kinematicBody, {place.length_m, parameters.pusher.thickness_m}, 1.0));
    state_->bodies.back()->SetTransform(single(place.home), 0.0f);
  }
}

PlainBox2d::~PlainBox2d() = default;

void PlainBox2d::step(const RecordedStep& motions) {
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const RecordedMotion& motion = motions[i];
    b2Body& body = *state_->bodies[i];
    if (body.IsEnabled() != motion.present) {
      body.SetTransform({motion.x, motion.y}, motion.angle);
      body.SetEnabled(motion.present);
    }
    if (!motion.present) continue;
    body.SetLinearVelocity({motion.vx, motion.vy});
    body.SetAngularVelocity(motion.spin);
  }
  state_->world.Step(0.005f, 8, 3);
}

int PlainBox2d::contacts() const {
  return state_->world.GetContactCount();
}

}  // namespace stepwright::bench

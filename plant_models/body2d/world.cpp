#include "plant_models/body2d/world.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "runtime/base/hash64.h"

namespace stepwright::body2d {
namespace {

b2Vec2 single(Vec2 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

Vec2 wide(const b2Vec2& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y)};
}

}  // namespace

// Sums up what Box2D's solver pressed with, by body.
class PressureListener final : public b2ContactListener {
 public:
  std::vector<double> impulse;  // N s in the present step, by BodyId
  std::vector<Vec2> push;       // the same as vectors

  void PostSolve(b2Contact* contact, const b2ContactImpulse* solved) override {
    double sum = 0.0;
    for (int i = 0; i < solved->count; ++i) sum += static_cast<double>(solved->normalImpulses[i]);
    b2WorldManifold manifold;
    contact->GetWorldManifold(&manifold);
    const Vec2 along = sum * wide(manifold.normal);  // from A to B
    const std::size_t a = contact->GetFixtureA()->GetBody()->GetUserData().pointer;
    const std::size_t b = contact->GetFixtureB()->GetBody()->GetUserData().pointer;
    impulse[a] += sum;
    impulse[b] += sum;
    push[a] = push[a] - along;
    push[b] = push[b] + along;
  }
};

struct World::State {
  WorldSettings settings;
  PressureListener pressure;
  b2World world{b2Vec2(0.0f, 0.0f)};
  std::vector<b2Body*> bodies;  // owned by the world

  explicit State(const WorldSettings& chosen) : settings(chosen) {
    world.SetContactListener(&pressure);
    world.SetAllowSleeping(false);  // a body that sleeps does not feel its belt start
    world.SetWarmStarting(true);
  }

  b2Body& of(BodyId id) const { return *bodies[id.value]; }

  BodyId add(b2BodyType type, const Pose& pose, const b2Shape& shape, double density, double friction) {
    b2BodyDef def;
    def.type = type;
    def.position = single(pose.position);
    def.angle = static_cast<float>(pose.angle);
    def.bullet = type == b2_dynamicBody;
    def.userData.pointer = bodies.size();
    b2Body* body = world.CreateBody(&def);
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.density = static_cast<float>(density);
    fixture.friction = static_cast<float>(friction);
    body->CreateFixture(&fixture);
    bodies.push_back(body);
    pressure.impulse.push_back(0.0);
    pressure.push.push_back({});
    return BodyId(static_cast<std::uint32_t>(bodies.size() - 1));
  }
};

World::World(const WorldSettings& settings) : state_(std::make_unique<State>(settings)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

BodyId World::add_wall(Vec2 from, Vec2 to, double friction) {
  b2EdgeShape edge;
  edge.SetTwoSided(single(from), single(to));
  return state_->add(b2_staticBody, {}, edge, 0.0, friction);
}

BodyId World::add_paddle(Rectangle rectangle, const Pose& pose, double friction) {
  b2PolygonShape shape;
  shape.SetAsBox(static_cast<float>(rectangle.size.x / 2.0), static_cast<float>(rectangle.size.y / 2.0));
  return state_->add(b2_kinematicBody, pose, shape, 0.0, friction);
}

BodyId World::add_box(const BoxBody& box, const Pose& pose) {
  b2PolygonShape shape;
  const Vec2 size = box.rectangle.size;
  shape.SetAsBox(static_cast<float>(size.x / 2.0), static_cast<float>(size.y / 2.0));
  return state_->add(b2_dynamicBody, pose, shape, box.mass_kg / (size.x * size.y), box.friction);
}

void World::set_present(BodyId body, bool present) {
  state_->of(body).SetEnabled(present);
}

bool World::present(BodyId body) const {
  return state_->of(body).IsEnabled();
}

Pose World::pose(BodyId body) const {
  const b2Body& at = state_->of(body);
  return {wide(at.GetPosition()), static_cast<double>(at.GetAngle())};
}

Motion World::motion(BodyId body) const {
  const b2Body& at = state_->of(body);
  return {wide(at.GetLinearVelocity()), static_cast<double>(at.GetAngularVelocity())};
}

void World::place(BodyId body, const Pose& pose, const Motion& motion) {
  b2Body& at = state_->of(body);
  at.SetTransform(single(pose.position), static_cast<float>(pose.angle));
  at.SetLinearVelocity(single(motion.velocity));
  at.SetAngularVelocity(static_cast<float>(motion.spin));
}

void World::drive(BodyId paddle, Vec2 velocity) {
  state_->of(paddle).SetLinearVelocity(single(velocity));
}

void World::push(BodyId box, Vec2 momentum, double angular_momentum) {
  b2Body& body = state_->of(box);
  body.ApplyLinearImpulseToCenter(single(momentum), true);
  body.ApplyAngularImpulse(static_cast<float>(angular_momentum), true);
}

double World::mass_kg(BodyId body) const {
  return static_cast<double>(state_->of(body).GetMass());
}

double World::inertia_kg_m2(BodyId body) const {
  return static_cast<double>(state_->of(body).GetInertia());
}

double World::pressed_n(BodyId body) const {
  return state_->pressure.impulse[body.value] / state_->settings.step_s;
}

Vec2 World::force_n(BodyId body) const {
  return (1.0 / state_->settings.step_s) * state_->pressure.push[body.value];
}

double World::kinetic_energy_j() const {
  double sum = 0.0;
  for (const b2Body* body : state_->bodies) {
    if (body->GetType() != b2_dynamicBody || !body->IsEnabled()) continue;
    const Vec2 v = wide(body->GetLinearVelocity());
    const double spin = static_cast<double>(body->GetAngularVelocity());
    sum += 0.5 * static_cast<double>(body->GetMass()) * (v.x * v.x + v.y * v.y) +
           0.5 * static_cast<double>(body->GetInertia()) * spin * spin;
  }
  return sum;
}

void World::step() {
  std::fill(state_->pressure.impulse.begin(), state_->pressure.impulse.end(), 0.0);
  std::fill(state_->pressure.push.begin(), state_->pressure.push.end(), Vec2{});
  state_->world.Step(static_cast<float>(state_->settings.step_s), state_->settings.velocity_iterations,
                     state_->settings.position_iterations);
}

double World::step_s() const {
  return state_->settings.step_s;
}

// Box2D keeps the memory of contacts that end. So a heap of bodies far away is made to touch and taken apart.
void World::warm_up(int contacts) {
  b2World& world = state_->world;
  std::vector<b2Body*> heap;
  int pairs = 0;
  for (int count = 0; pairs < contacts; pairs += count, ++count) {
    b2BodyDef def;
    def.type = b2_dynamicBody;
    def.position.Set(1000.0f + 0.01f * static_cast<float>(count), 1000.0f);
    def.bullet = true;
    heap.push_back(world.CreateBody(&def));
    b2PolygonShape shape;
    shape.SetAsBox(0.5f, 0.5f);
    heap.back()->CreateFixture(&shape, 1.0f);
    heap.back()->GetUserData().pointer = 0;
  }
  if (state_->bodies.empty()) {
    state_->pressure.impulse.resize(1);
    state_->pressure.push.resize(1);
  }
  world.Step(0.0f, 1, 1);
  for (b2Body* body : heap) world.DestroyBody(body);
  state_->pressure.impulse.resize(state_->bodies.size());
  state_->pressure.push.resize(state_->bodies.size());
}

std::uint64_t World::hash() const {
  std::uint64_t hash = 0;
  const auto mix = [&hash](double value) {
    hash = base::hash_mix(hash, std::bit_cast<std::uint64_t>(value));
  };
  for (std::uint32_t i = 0; i < state_->bodies.size(); ++i) {
    const BodyId id(i);
    const Pose at = pose(id);
    const Motion moves = motion(id);
    mix(at.position.x), mix(at.position.y), mix(at.angle);
    mix(moves.velocity.x), mix(moves.velocity.y), mix(moves.spin);
    mix(present(id) ? 1.0 : 0.0);
  }
  return hash;
}

}  // namespace stepwright::body2d

#include "supervisor/motion/collision/internal/make_program.h"

#include <algorithm>
#include <cmath>

#include "supervisor/motion/kinematics/turning.h"

namespace stepwright::motion::internal {

namespace {

std::array<float, 3> single(const Vector3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
std::array<float, 9> single(const Rotation& r) {
  std::array<float, 9> out{};
  for (std::size_t k = 0; k < 9; ++k) out[k] = static_cast<float>(r.m[k]);
  return out;
}

// Where a link is in the frame of the body that carries it.
struct Carried {
  std::size_t body = 0;
  Transform place;
};

class ProgramMaker {
 public:
  ProgramMaker(const Robot& robot, std::span<const int> coordinates, std::span<const double> rest,
               double rounding_m)
      : robot_(robot),
        coordinates_(coordinates),
        rest_(rest),
        rounding_m_(rounding_m),
        carried_(robot.links.size()) {
    program_.columns = coordinates.size();
    reach_.push_back({});
  }

  Program make(const SphereModel& spheres, const Semantics& semantics, const World& world) {
    for (std::size_t j = 0; j < robot_.joints.size(); ++j) add_joint(j);
    add_parts(spheres);
    for (const Obstacle& each : world.obstacles)
      if (each.shape.kind == ShapeKind::Mesh)
        add_mesh(each, world);
      else
        add_solid(each, world);
    add_pairs(semantics);
    return std::move(program_);
  }

 private:
  // Of a body: where the way to it begins, which does not move, and how far its frame can be from there.
  struct Reach {
    Vector3 from_m;
    double far_m = 0.0;
  };

  void add_joint(std::size_t j) {
    const Joint& joint = robot_.joints[j];
    const Carried& parent = carried_[static_cast<std::size_t>(joint.parent)];
    const Transform origin = parent.place * joint.origin;
    const auto column = std::find(coordinates_.begin(), coordinates_.end(), joint.coordinate);
    if (joint.coordinate < 0 || column == coordinates_.end()) {
      Transform motion;
      if (joint.coordinate >= 0) {
        const double value =
            joint.multiplier * rest_[static_cast<std::size_t>(joint.coordinate)] + joint.offset;
        if (joint.kind == JointKind::Prismatic)
          motion.position_m = value * joint.axis;
        else
          motion.rotation = about(joint.axis, value);
      }
      carried_[j + 1] = {parent.body, origin * motion};
      return;
    }
    BodyStep step;
    step.parent = parent.body;
    step.column = static_cast<std::size_t>(column - coordinates_.begin());
    step.slides = joint.kind == JointKind::Prismatic;
    step.multiplier = static_cast<float>(joint.multiplier);
    step.offset = static_cast<float>(joint.offset);
    step.origin = single(origin.position_m);
    const Turning turning(origin.rotation, joint.axis);
    step.still = single(step.slides ? origin.rotation : turning.still());
    step.with_cosine = single(turning.with_cosine());
    step.with_sine = single(turning.with_sine());
    step.along = single(origin.rotation * joint.axis);
    program_.steps.push_back(step);
    Reach reach = reach_[parent.body];
    if (parent.body == 0)
      reach.from_m = origin.position_m;
    else
      reach.far_m += length(origin.position_m);
    if (step.slides) {
      const Coordinate& limits = robot_.coordinates[static_cast<std::size_t>(joint.coordinate)];
      reach.far_m += std::abs(joint.multiplier) * std::max(std::abs(limits.lower), std::abs(limits.upper)) +
                     std::abs(joint.offset);
    }
    reach_.push_back(reach);
    carried_[j + 1] = {program_.steps.size(), {}};
  }

  Ball ball(const Sphere& sphere, const Transform& place) const {
    return {single(place * sphere.centre_m), static_cast<float>(sphere.radius_m + rounding_m_)};
  }

  // Around the mean of their centres: not the smallest sphere, but soon made.
  Ball bound_around(std::size_t first, std::size_t end) const {
    Ball bound;
    const std::span<const Ball> balls(program_.balls.data() + first, end - first);
    for (const Ball& each : balls)
      for (std::size_t i = 0; i < 3; ++i)
        bound.centre[i] += each.centre[i] / static_cast<float>(balls.size());
    for (const Ball& each : balls) {
      const float x = each.centre[0] - bound.centre[0], y = each.centre[1] - bound.centre[1],
                  z = each.centre[2] - bound.centre[2];
      bound.radius = std::max(bound.radius, std::sqrt(x * x + y * y + z * z) + each.radius);
    }
    bound.radius += static_cast<float>(rounding_m_);
    return bound;
  }

  void add_groups(Part& part) {
    part.first_group = program_.groups.size();
    for (std::size_t k = part.first; k < part.end; k += kSpheresTogether) {
      const std::size_t end = std::min(k + kSpheresTogether, part.end);
      program_.groups.push_back({part.body, bound_around(k, end), k, end});
    }
    part.end_group = program_.groups.size();
  }

  void add_parts(const SphereModel& spheres) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < robot_.links.size(); ++k)
      if (!spheres.links[k].spheres.empty()) order.push_back(k);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return carried_[a].body > carried_[b].body; });
    for (const std::size_t link : order) {
      const Carried& carried = carried_[link];
      Part part;
      part.body = carried.body;
      part.link = link;
      part.bound = ball(spheres.links[link].bound, carried.place);
      part.bound.radius += static_cast<float>(rounding_m_);  // it contains the rounded spheres, too
      part.first = program_.balls.size();
      for (const Sphere& each : spheres.links[link].spheres)
        program_.balls.push_back(ball(each, carried.place));
      part.end = program_.balls.size();
      add_groups(part);
      if (carried.body > 0) {
        ++program_.moving_parts;
        program_.moving_balls = part.end;
        program_.moving_groups = part.end_group;
      }
      program_.parts.push_back(std::move(part));
      links_.push_back(link);
    }
  }

  static Solid solid(const Shape& shape) {
    Solid out;
    out.centre = single(shape.origin.position_m);
    out.rows = single(transposed(shape.origin.rotation));
    switch (shape.kind) {
      case ShapeKind::Cylinder:
        out.kind = Solid::Kind::Cylinder;
        out.half = single(Vector3{shape.radius_m, 0.5 * shape.length_m, 0.0});
        break;
      case ShapeKind::Sphere:
        out.kind = Solid::Kind::Sphere;
        out.half = single(Vector3{shape.radius_m, 0.0, 0.0});
        break;
      default:
        out.half = single(0.5 * shape.size_m);
    }
    return out;
  }

  // How far from where its way begins any point of a part can be.
  double far_of(const Part& part) const {
    const Vector3 centre{part.bound.centre[0], part.bound.centre[1], part.bound.centre[2]};
    return reach_[part.body].far_m + length(centre) + static_cast<double>(part.bound.radius) + rounding_m_;
  }

  bool comes_near(const Part& part, std::size_t link, const Obstacle& obstacle, const World& world) const {
    return distance_below(obstacle, reach_[part.body].from_m) <= far_of(part) &&
           !world.may_touch(robot_.links[link].name, obstacle.name);
  }

  void add_solid(const Obstacle& obstacle, const World& world) {
    const auto number = static_cast<std::uint32_t>(program_.solids.size());
    program_.solids.push_back(solid(obstacle.shape));
    for (std::size_t k = 0; k < program_.moving_parts; ++k)
      if (comes_near(program_.parts[k], links_[k], obstacle, world))
        program_.parts[k].obstacles.push_back(number);
  }

  // The spheres of a mesh are a part that stands still.
  void add_mesh(const Obstacle& obstacle, const World& world) {
    Part part;
    part.bound = ball(bound_of(*obstacle.spheres), obstacle.shape.origin);
    part.bound.radius += static_cast<float>(rounding_m_);
    part.first = program_.balls.size();
    for (const Sphere& each : *obstacle.spheres) program_.balls.push_back(ball(each, obstacle.shape.origin));
    part.end = program_.balls.size();
    add_groups(part);
    const auto number = static_cast<std::uint32_t>(program_.parts.size());
    program_.parts.push_back(std::move(part));
    for (std::size_t k = 0; k < program_.moving_parts; ++k)
      if (comes_near(program_.parts[k], links_[k], obstacle, world))
        program_.pairs.emplace_back(static_cast<std::uint32_t>(k), number);
  }

  void add_pairs(const Semantics& semantics) {
    const std::size_t links = robot_.links.size();
    std::vector<std::uint8_t> disabled(links * links, 0);
    for (const auto& [one, other] : semantics.disabled) {
      const auto a = static_cast<std::size_t>(one), b = static_cast<std::size_t>(other);
      if (a < links && b < links) disabled[a * links + b] = disabled[b * links + a] = 1;
    }
    for (std::size_t a = 0; a < program_.moving_parts; ++a)
      for (std::size_t b = a + 1; b < links_.size(); ++b)
        if (program_.parts[a].body != program_.parts[b].body && disabled[links_[a] * links + links_[b]] == 0)
          program_.pairs.emplace_back(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
  }

  const Robot& robot_;
  std::span<const int> coordinates_;
  std::span<const double> rest_;
  double rounding_m_;
  std::vector<Carried> carried_;
  std::vector<Reach> reach_;
  std::vector<std::size_t> links_;  // of the parts but for those of meshes
  Program program_;
};

}  // namespace

Program make_program(const Robot& robot, const SphereModel& spheres, const Semantics& semantics,
                     const World& world, std::span<const int> coordinates, std::span<const double> rest,
                     double rounding_m) {
  return ProgramMaker(robot, coordinates, rest, rounding_m).make(spheres, semantics, world);
}

}  // namespace stepwright::motion::internal

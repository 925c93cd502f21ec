#include "supervisor/motion/collision/collision_checker.h"

#include <algorithm>
#include <cmath>

#include "supervisor/motion/collision/internal/make_program.h"

namespace stepwright::motion {

result::Result<CollisionChecker> CollisionChecker::make(const Robot& robot, const SphereModel& spheres,
                                                        const Semantics* semantics, const World& world,
                                                        std::span<const int> coordinates,
                                                        std::span<const double> rest,
                                                        const std::vector<AttachedBody>& attached) {
  if (auto sound = check_world(world); !sound) return result::forward(sound);
  if (auto sound = check_attached(robot, attached); !sound) return result::forward(sound);
  CollisionChecker checker;
  if (attached.empty() && semantics != nullptr && std::ranges::is_sorted(semantics->disabled)) {
    checker.program_ =
        internal::make_program(robot, spheres, *semantics, world, coordinates, rest, kRounding_m);
    return checker;
  }
  const CarryingRobot all = carrying(robot, &spheres, nullptr, semantics, attached);
  checker.program_ =
      internal::make_program(all.robot, all.spheres, all.semantics, world, coordinates, rest, kRounding_m);
  return checker;
}

CollisionChecker CollisionChecker::without_world(std::span<const std::uint8_t> links) const {
  CollisionChecker checker = *this;
  internal::Program& program = checker.program_;
  const auto is_one = [&](const internal::Part& part) {
    return part.link < links.size() && links[part.link] != 0;
  };
  for (internal::Part& part : program.parts)
    if (is_one(part)) part.obstacles.clear();
  std::erase_if(program.pairs, [&](const std::pair<std::uint32_t, std::uint32_t>& pair) {
    return program.parts[pair.second].link == internal::Part::kNone && is_one(program.parts[pair.first]);
  });
  return checker;
}

bool CollisionChecker::is_free(std::span<const double> configuration) const {
  std::uint8_t collides = 0;
  internal::check_simd(program_, configuration.data(), 1, true, &collides);
  return collides == 0;
}

std::vector<std::uint8_t> CollisionChecker::collisions(std::span<const double> configurations) const {
  if (columns() == 0) return {};
  std::vector<std::uint8_t> found(configurations.size() / columns());
  internal::check_simd(program_, configurations.data(), found.size(), false, found.data());
  return found;
}

bool CollisionChecker::all_free(std::span<const double> configurations) const {
  if (columns() == 0) return true;
  std::vector<std::uint8_t> found(configurations.size() / columns());
  internal::check_simd(program_, configurations.data(), found.size(), true, found.data());
  return std::find(found.begin(), found.end(), 1) == found.end();
}

bool CollisionChecker::motion_is_free(std::span<const double> from, std::span<const double> to,
                                      double step) const {
  double farthest = 0.0;
  for (std::size_t k = 0; k < columns(); ++k) farthest = std::max(farthest, std::abs(to[k] - from[k]));
  const auto steps = static_cast<std::size_t>(std::ceil(farthest / step));
  const std::size_t places = steps + 1, lanes = internal::simd_lanes();
  const std::size_t batches = (places + lanes - 1) / lanes;
  std::vector<double> rows;
  rows.reserve(places * columns());
  for (std::size_t batch = 0; batch < batches; ++batch)
    for (std::size_t place = batch; place < places; place += batches) {
      const double share = steps == 0 ? 0.0 : static_cast<double>(place) / static_cast<double>(steps);
      for (std::size_t k = 0; k < columns(); ++k)
        rows.push_back(place == steps && steps > 0 ? to[k] : from[k] + share * (to[k] - from[k]));
    }
  return all_free(rows);
}

}  // namespace stepwright::motion

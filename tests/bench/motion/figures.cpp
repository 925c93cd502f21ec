#include "tests/bench/motion/figures.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/kinematics/newton.h"
#include "supervisor/motion/kinematics/srs_arm.h"
#include "supervisor/motion/spatial/random.h"
#include "tests/bench/motion/processor_time.h"

namespace stepwright::bench {

namespace {

using namespace motion;

std::vector<double> draw(const MotionScene& scene, std::size_t count) {
  Random random(1);
  std::vector<double> rows;
  for (std::size_t k = 0; k < count; ++k)
    for (const int each : scene.coordinates) {
      const Coordinate& limits = scene.robot.coordinates[static_cast<std::size_t>(each)];
      rows.push_back(random.between(limits.lower, limits.upper));
    }
  return rows;
}

double error_of(const Transform& a, const Transform& b) {
  return std::max(distance(a.position_m, b.position_m), angle_between(a.rotation, b.rotation));
}

double percent(const std::vector<std::uint8_t>& collides) {
  return 100.0 * std::accumulate(collides.begin(), collides.end(), 0.0) /
         static_cast<double>(collides.size());
}

CheckFigures by_fcl(const MotionScene& scene, const char* name, const Bodies& bodies,
                    const std::vector<double>& rows) {
  const auto exact =
      *ExactChecker::make(scene.robot, bodies, &scene.semantics, scene.world, scene.coordinates, scene.rest);
  const std::size_t count = std::min<std::size_t>(rows.size() / exact.columns(), 2000);
  std::vector<std::uint8_t> found(count);
  const double time = processor_seconds([&] {
    for (std::size_t k = 0; k < count; ++k)
      found[k] = exact.contact({rows.data() + k * exact.columns(), exact.columns()}).has_value();
  });
  return {name, static_cast<double>(count) / time, percent(found)};
}

}  // namespace

KinematicsFigures measure_kinematics(const MotionScene& scene) {
  const std::size_t poses = 10'000;
  const Chain chain = *Chain::between(scene.robot, scene.robot.link("torso"), scene.robot.link("right_tcp"));
  const SrsArm arm = *SrsArm::recognise(chain);
  const auto rows = draw(scene, poses);
  const auto row = [&](std::size_t k) { return std::span<const double>(rows.data() + 7 * k, 7); };
  std::vector<Transform> tips(poses);
  KinematicsFigures figures;
  const auto each_ns = [&](const std::function<void(std::size_t)>& work, std::size_t count) {
    return 1e9 / static_cast<double>(count) * processor_seconds([&] {
             for (std::size_t k = 0; k < count; ++k) work(k);
           });
  };
  figures.forward_ns = each_ns([&](std::size_t k) { tips[k] = chain.forward(row(k)); }, poses);
  std::array<double, 42> columns;
  figures.jacobian_ns = each_ns([&](std::size_t k) { chain.jacobian(row(k), columns); }, poses);
  const LinkFrames links(scene.robot);
  std::vector<Transform> frames(scene.robot.links.size());
  std::vector<double> configuration = scene.rest;
  figures.all_links_ns = each_ns(
      [&](std::size_t k) {
        configuration[0] = rows[k];
        links.place(configuration, frames);
      },
      poses);
  std::size_t solutions = 0;
  figures.closed_form_ns = each_ns([&](std::size_t k) { solutions += arm.solve(tips[k], 0.5).count; }, poses);
  figures.arcs_us = 1e-3 * each_ns([&](std::size_t k) { solutions += arm.arcs(tips[k]).size(); }, poses);
  for (std::size_t k = 0; k < poses; ++k)
    for (std::size_t b = 0; b < SrsBranch::kCount; ++b)
      if (const auto found = arm.solve(tips[k], 0.5, SrsBranch::number(b), false))
        figures.worst_closed_form_m =
            std::max(figures.worst_closed_form_m, error_of(chain.forward(found->q), tips[k]));
  constexpr std::size_t kByNewton = 500;
  std::size_t found = 0;
  figures.newton_us =
      1e-3 * each_ns([&](std::size_t k) { found += !solve_by_newton(chain, tips[k], {.seed = k}).empty(); },
                     kByNewton);
  figures.newton_found_percent = 100.0 * static_cast<double>(found) / (5.0 * kByNewton);
  return figures;
}

std::vector<CheckFigures> measure_checks(const MotionScene& scene) {
  constexpr std::size_t kConfigurations = 20'000;
  const auto checker = *CollisionChecker::make(scene.robot, scene.spheres, &scene.semantics, scene.world,
                                               scene.coordinates, scene.rest);
  const auto rows = draw(scene, kConfigurations);
  std::vector<CheckFigures> figures;
  std::vector<std::uint8_t> found(kConfigurations);
  const double plain = processor_seconds(
      [&] { internal::check_scalar(checker.program(), rows.data(), kConfigurations, false, found.data()); });
  figures.push_back({"plain arithmetic", kConfigurations / plain, percent(found)});
  for (const std::int64_t target : internal::simd_targets()) {
    internal::choose_simd_target(target);
    const double time = processor_seconds([&] { found = checker.collisions(rows); });
    figures.push_back({internal::simd_target_name(target), kConfigurations / time, percent(found)});
  }
  internal::choose_simd_target(0);
  Bodies spheres;
  for (const LinkSpheres& link : scene.spheres.links) {
    spheres.emplace_back();
    for (const Sphere& each : link.spheres)
      spheres.back().push_back({sphere("", each.centre_m, each.radius_m).shape, nullptr});
  }
  figures.push_back(by_fcl(scene, "FCL, same spheres", spheres, rows));
  figures.push_back(by_fcl(scene, "FCL, bodies", scene.bodies, rows));
  return figures;
}

}  // namespace stepwright::bench

// The ground of motion planning, measured (figures.h).
//
//   bench_motion [--json FILE] [--robot FOLDER]

#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bench/motion/figures.h"

namespace stepwright::bench {
namespace {

int run(const std::string& json_file, const std::string& folder) {
  const MotionScene scene = motion_scene(folder);
  const KinematicsFigures arm = measure_kinematics(scene);
  nlohmann::json out = {{"motion_forward_ns", arm.forward_ns},
                        {"motion_jacobian_ns", arm.jacobian_ns},
                        {"motion_all_links_ns", arm.all_links_ns},
                        {"motion_closed_form_ns", arm.closed_form_ns},
                        {"motion_arcs_us", arm.arcs_us},
                        {"motion_newton_us", arm.newton_us},
                        {"motion_newton_found_percent", arm.newton_found_percent},
                        {"motion_worst_closed_form_m", arm.worst_closed_form_m},
                        {"motion_spheres", scene.spheres.count()}};
  std::printf("tip of seven joints %.0f ns, Jacobian %.0f ns, all %zu links %.0f ns\n", arm.forward_ns,
              arm.jacobian_ns, scene.robot.links.size(), arm.all_links_ns);
  std::printf(
      "closed form, all solutions of a swivel %.0f ns (worst error %.1e m or rad), all arcs %.2f us\n",
      arm.closed_form_ns, arm.worst_closed_form_m, arm.arcs_us);
  std::printf("Newton, one solution %.1f us, found %.1f %%\n", arm.newton_us, arm.newton_found_percent);
  double best = 0.0, fcl = 0.0;
  for (const CheckFigures& each : measure_checks(scene)) {
    std::printf("%-18s %12.0f checks a second, %.1f %% collide\n", each.name.c_str(), each.per_s,
                each.colliding_percent);
    out["motion_checks"][each.name] = each.per_s;
    if (each.name == "FCL, same spheres")
      fcl = each.per_s;
    else if (fcl == 0.0)
      best = std::max(best, each.per_s);
  }
  out["motion_ratio_to_fcl"] = best / fcl;
  std::printf("%zu spheres; %.0f times as fast as FCL with the same spheres\n", scene.spheres.count(),
              best / fcl);
  if (json_file.empty()) return 0;
  std::ofstream file(json_file);
  file << out.dump(2) << "\n";
  return file.flush() ? 0 : 1;
}

}  // namespace
}  // namespace stepwright::bench

int main(int argc, char** argv) {
  std::string json_file, folder = "tests/cells/robot_cell";
  bool sound = argc % 2 == 1;
  for (int k = 1; k + 1 < argc; k += 2) {
    const std::string option = argv[k];
    if (option == "--json")
      json_file = argv[k + 1];
    else if (option == "--robot")
      folder = argv[k + 1];
    else
      sound = false;
  }
  if (!sound) {
    std::fprintf(stderr, "usage: bench_motion [--json FILE] [--robot FOLDER]\n");
    return 2;
  }
  try {
    return stepwright::bench::run(json_file, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_motion: %s\n", error.what());
    return 1;
  }
}

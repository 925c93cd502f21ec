// The ground of motion planning, measured (figures.h). Whole problems: bench_arm.
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
  const TimingFigures timing = measure_timing();
  std::printf("blends and time law of 10 way-points, 7 joints %.2f ms, %.0f rows; straight %.2f us\n",
              timing.blend_and_timing_ms, timing.rows, timing.straight_us);
  std::printf("duration over the minimum on a grid four times as fine: mean %.4f, worst %.4f\n",
              timing.mean_ratio, timing.worst_ratio);
  std::printf("over a proved lower bound there: mean %.4f, worst %.4f, within 1.01 in %.0f %%\n",
              timing.mean_bound_ratio, timing.worst_bound_ratio, timing.within_one_percent);
  std::printf("%zu random paths judged: %zu exceed a limit; greatest use of a limit %.12f\n", timing.paths,
              timing.violations, timing.worst_share);
  out["motion_timing_ms"] = timing.blend_and_timing_ms;
  out["motion_timing_rows"] = timing.rows;
  out["motion_timing_straight_us"] = timing.straight_us;
  out["motion_timing_ratio"] = timing.mean_ratio;
  out["motion_timing_worst_ratio"] = timing.worst_ratio;
  out["motion_timing_bound_ratio"] = timing.mean_bound_ratio;
  out["motion_timing_worst_bound_ratio"] = timing.worst_bound_ratio;
  out["motion_timing_within_one_percent"] = timing.within_one_percent;
  out["motion_timing_violations"] = timing.violations;
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
  try {
    for (int k = 1; k + 1 < argc; k += 2) {
      const std::string option = argv[k], value = argv[k + 1];
      if (option == "--json")
        json_file = value;
      else if (option == "--robot")
        folder = value;
      else
        sound = false;
    }
    if (sound) return stepwright::bench::run(json_file, folder);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_motion: %s\n", error.what());
    return 1;
  }
  std::fprintf(stderr, "usage: bench_motion [--json FILE] [--robot FOLDER]\n");
  return 2;
}

#include "supervisor/tamp/predicates/certify.h"

#include <utility>

#include "supervisor/motion/path/certain_path.h"

namespace stepwright::tamp::predicates {

namespace {

std::string text_of(const motion::MotionVerdict& verdict) {
  const char* const how =
      verdict.kind == motion::MotionVerdict::Kind::TooClose ? " comes too close to " : " meets ";
  return verdict.contact.link + how + verdict.contact.other;
}

}  // namespace

std::optional<Uncertain> certify(Workspace& workspace, std::vector<Settled>& settled, std::uint64_t seed) {
  return certify(workspace, settled, seed, initial_state(workspace.cell()), false);
}

std::optional<Uncertain> certify(Workspace& workspace, std::vector<Settled>& settled, std::uint64_t seed,
                                 scene::GeometricState state, bool leaves) {
  const scene::RobotCell& cell = workspace.cell();
  std::vector<bool> moved(cell.arms.size(), false);
  for (std::size_t k = 0; k < settled.size(); ++k) {
    const int arm = settled[k].action.what.arm;
    scene::ArmState& moving = state.arms[static_cast<std::size_t>(arm)];
    std::optional<motion::ExactChecker> exact;
    double half_open_m = -1.0;
    for (scene::Motion& each : settled[k].action.motions) {
      if (!exact || each.half_open_m != half_open_m) {
        moving.half_open_m = half_open_m = each.half_open_m;
        const scene::Surroundings around = surroundings(cell, state, kHeldShrunk_m);
        auto made = motion::ExactChecker::make(cell.robot, cell.bodies, &cell.semantics, around.world,
                                               cell.arms[static_cast<std::size_t>(arm)].coordinates,
                                               values_of(cell, state), &cell.spheres, around.held);
        if (!made) return Uncertain{k, each.phase, "the scene cannot be checked"};
        exact.emplace(*std::move(made));
      }
      const bool path = each.phase == scene::Phase::Transfer;
      const bool first = !moved[static_cast<std::size_t>(arm)];
      moved[static_cast<std::size_t>(arm)] = true;
      if (leaves && first && each.phase == scene::Phase::Lift) continue;
      if (path)
        each.path = motion::shorten(workspace.path_checker(state, arm), std::move(each.path), {.seed = seed});
      const auto refused = motion::first_refused(*exact, each.path);
      if (!refused) continue;
      if (!path) return Uncertain{k, each.phase, text_of(*refused)};
      motion::PathOptions options;
      options.seed = seed + 1;
      options.step = 0.01;
      auto again =
          motion::plan_certain_path(workspace.path_checker(state, arm), *exact, workspace.joint_space(arm),
                                    each.path.front(), {each.path.back()}, options);
      if (again.path.empty()) return Uncertain{k, each.phase, text_of(*refused)};
      each.path = std::move(again.path);
    }
    state = settled[k].after;
  }
  return std::nullopt;
}

}  // namespace stepwright::tamp::predicates
